#pragma once

#include <Eigen/Core>

#include "core/model/design.hpp"

namespace loopscope::core::model {

/// Least squares over the coefficients of a design.
struct Solution {
  Design design;
  Eigen::MatrixXd normal;  ///< products of the design's columns over the fit rows
  Eigen::VectorXd coefficients;
  Eigen::VectorXd errors;  ///< one-step errors of every sample
  double fit_error = 0.0;  ///< their mean square on the fit rows
};

/// Of normal x = right, scaled and with a slight ridge.
[[nodiscard]] Eigen::VectorXd solve_normal(const Eigen::MatrixXd& normal,
                                           const Eigen::VectorXd& right);

/// The structure after a Gauss-Newton step of its nonlinear parameters (poles of process and noise,
/// zeros of noise), the coefficients following, held to where a model makes sense.
[[nodiscard]] Structure newton_step(const LoopData& data, const Solution& solution,
                                    const Structure& structure, double damping);

}  // namespace loopscope::core::model
