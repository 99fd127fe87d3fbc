#pragma once

#include <Eigen/Core>

#include "core/model/fit/design.hpp"

namespace loopscope::core::model {

/// Least squares over the coefficients of a design.
struct Solution {
  Design design;
  Eigen::MatrixXd normal;  ///< products of the design's columns over the fit rows
  Eigen::VectorXd coefficients;
  Eigen::VectorXd errors;  ///< one-step errors of every sample
  double fit_error = 0.0;  ///< their mean square on the fit rows
};

/// Of a column's square: collinear columns (a PI law ties op to pv) share their weight instead of
/// breaking the solution.
inline constexpr double kRidge = 1e-9;
/// Behind two integrators of the noise the offset leaves nothing but rounding to fit, and is no
/// coefficient; whatever moves pv at all leaves more.
inline constexpr double kPrior = 1e-20;

/// Of normal x = right, scaled and with that ridge.
[[nodiscard]] Eigen::VectorXd solve_normal(const Eigen::MatrixXd& normal,
                                           const Eigen::VectorXd& right);

/// What solve_normal() multiplies `right` by, from one factorisation.
[[nodiscard]] Eigen::MatrixXd inverse_of_normal(const Eigen::MatrixXd& normal);

/// A structure after a step, and by what share (0 to 1) the error on the fit rows should fall.
struct NextStructure {
  Structure structure;
  double promise = 0.0;
};

/// A Gauss-Newton step of a structure's nonlinear parameters (poles of process and noise, zeros of
/// noise), the coefficients following.
class NewtonStep {
 public:
  NewtonStep(const LoopData& data, const Solution& solution, const Structure& structure);

  /// The structure after the step, held to where a model makes sense. A step that was too long is
  /// taken again with more damping at little cost.
  [[nodiscard]] NextStructure take(double damping) const;

 private:
  Structure structure_;
  double squares_;         ///< of the errors on the fit rows
  Eigen::MatrixXd joint_;  ///< products of regressors and sensitivities, with the errors last
};

}  // namespace loopscope::core::model
