#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/model/residual_tests/statistics/centred.hpp"
#include "core/model/residual_tests/statistics/linear_span.hpp"
#include "core/model/residual_tests/statistics/residual_view.hpp"
#include "core/model/residual_tests/statistics/value_grid.hpp"

namespace loopscope::core::model {

/// What several questions need of one residual, worked out once.
struct ResidualContext {
  ResidualView view;
  Centred residual;
  std::optional<Centred> op;        ///< nullopt = missing or constant
  std::optional<Centred> response;  ///< nullopt = missing or constant
  std::optional<Centred> pv;        ///< nullopt = missing or constant
  std::vector<double> op_sorted;    ///< recorded values, ascending
  double fast_noise_std = 0.0;      ///< pv units, see fast_noise.hpp
  ValueGrid grid;                   ///< of pv
  Eigen::ArrayXd recorded;          ///< 1 where the residual is, else 0
  /// A constant, and the constant with the residual's own past and op's.
  LinearSpan constant;
  LinearSpan linear_past;
  /// The residual less what linear_past explains. A linear loop whose delay is no whole number of
  /// samples, or whose order is higher than the fit's, leaves traces of op and of itself, which
  /// every question but `white` and `op_dynamics` would take for its own: without this
  /// `op_direction` passed at 0.01 in 4 % of 500 loops without an effect.
  Eigen::VectorXd beyond_linear;
  Centred fresh;  ///< the same about its mean, in units of its standard deviation

  /// Close together where short delays lie, further apart where long ones do.
  static constexpr std::array<int, 5> kOpLags = {1, 2, 4, 7, 12};
};

/// Fewest samples on which anything is asked; the sizes are measured from 750 on.
inline constexpr std::size_t kFewestAsked = 200;

/// nullopt when the residual has fewer than kFewestAsked samples or no variance.
/// Throws std::invalid_argument when the spans differ in length or the interval is not positive.
[[nodiscard]] std::optional<ResidualContext> prepare_context(const ResidualView& view);

}  // namespace loopscope::core::model
