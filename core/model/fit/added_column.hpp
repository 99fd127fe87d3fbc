#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// Least squares with one regressor more than those that stay, many times over: what the ones that
/// stay take is worked out once. solve_normal() of all of them, up to rounding.
class AddedColumn {
 public:
  /// Products of the columns that stay with one another; pv's first, then the regressors.
  explicit AddedColumn(const Eigen::MatrixXd& steady_normal);

  /// The sum of squares that is left, in units of pv_scale squared; `moved`: the added column's
  /// products with those columns, in their order, and with itself.
  [[nodiscard]] double squares_left(std::span<const double> moved);

 private:
  std::vector<double> diagonal_;      ///< of the regressors' products
  std::vector<double> coefficients_;  ///< without the added column
  Eigen::MatrixXd inverse_;           ///< of the regressors' products
  std::vector<double> reduced_;       ///< scratch: what the regressors share with the added one
  double squares_;                    ///< of pv less what the regressors take, but for the ridge
};

}  // namespace loopscope::core::model
