#pragma once

#include <Eigen/Core>

namespace loopscope::core::hos {

/// matrix = vectors * values.asDiagonal() * vectors.transpose().
struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< a column each, orthonormal
};

/// Of a finite symmetric matrix, of which the lower triangle is read. Compiled once: Eigen's solver
/// takes seconds to compile in each file that uses it, and again for each fixed size.
[[nodiscard]] SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

}  // namespace loopscope::core::hos
