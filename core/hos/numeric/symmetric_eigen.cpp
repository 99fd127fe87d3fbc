#include "core/hos/numeric/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace loopscope::core::hos {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace loopscope::core::hos
