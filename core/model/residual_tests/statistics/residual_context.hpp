#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/model/residual_tests/statistics/centred.hpp"
#include "core/model/residual_tests/statistics/linear_span.hpp"
#include "core/model/residual_tests/statistics/value_grid.hpp"

namespace loopscope::core::model {

/// What a fitted loop model leaves, beside what it was fitted to. All spans have one length; NaN is
/// a missing sample. A span of the right length full of NaN stands for a signal that nobody has.
struct ResidualView {
  /// r(k) = pv(k) - its one-step prediction, pv units; white when the model is right.
  std::span<const double> innovation;
  std::span<const double> op_percent;  ///< % of its range, or op units without one
  /// Sign of op's last motion beyond its noise, known at k: +1 or -1; 0 = it has not moved yet.
  std::span<const double> op_direction;
  /// x(k): the deterministic output of the model, driven by op before k, pv units.
  std::span<const double> response;
  std::span<const double> pv;      ///< pv units
  double sample_interval_s = 1.0;  ///< > 0
  /// pv less the waves and loads that the model has, pv units; empty = it has none.
  std::span<const double> pv_undisturbed{};
};

/// How much pv varies from one sample to the next, pv units: the larger of the standard deviations
/// of its increments over sqrt(2) and of the innovations, each without its largest fiftieth
/// (setpoint and load steps). 0 when nothing varies.
[[nodiscard]] double fast_noise_std(const ResidualView& view);

/// What several questions need of one residual, worked out once.
struct ResidualContext {
  ResidualView view;
  Centred residual;
  std::optional<Centred> op;        ///< nullopt = missing or constant
  std::optional<Centred> response;  ///< nullopt = missing or constant
  std::optional<Centred> pv;        ///< nullopt = missing or constant
  std::vector<double> op_sorted;    ///< recorded values, ascending
  double fast_noise_std = 0.0;      ///< pv units, see fast_noise_std()
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
