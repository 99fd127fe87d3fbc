#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/model/questions/centred.hpp"
#include "core/model/questions/value_grid.hpp"
#include "core/model/residual_view.hpp"

namespace loopscope::core::model {

/// What several questions need of one residual, worked out once.
struct Questioned {
  ResidualView view;
  Centred residual;
  std::optional<Centred> op;        ///< nullopt = missing or constant
  std::optional<Centred> response;  ///< nullopt = missing or constant
  std::optional<Centred> pv;        ///< nullopt = missing or constant
  std::vector<double> op_sorted;    ///< recorded values, ascending
  double fast_noise_std = 0.0;      ///< pv units, see fast_noise.hpp
  ValueGrid grid;                   ///< of pv
  Eigen::ArrayXd recorded;          ///< 1 where the residual is, else 0
  /// Orthonormal over the recorded samples, zero elsewhere: a constant, and the constant with op at
  /// kOpLags. What they say of the residual is no business of the questions on op's direction and
  /// level: op answers to past residuals, and its linear part was fitted.
  Eigen::MatrixXd constant;
  Eigen::MatrixXd past_op;
  Eigen::VectorXd beyond_op;  ///< the residual less what past_op explains

  /// Close together where short delays lie, further apart where long ones do.
  static constexpr std::array<int, 5> kOpLags = {1, 2, 4, 7, 12};
};

/// Fewest samples on which anything is asked; the sizes are measured from 750 on.
inline constexpr std::size_t kFewestAsked = 200;

/// nullopt when the residual has fewer than kFewestAsked samples or no variance.
/// Throws std::invalid_argument when the spans differ in length or the interval is not positive.
[[nodiscard]] std::optional<Questioned> prepare_questions(const ResidualView& view);

}  // namespace loopscope::core::model
