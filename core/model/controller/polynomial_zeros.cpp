#include "core/model/controller/polynomial_zeros.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

namespace loopscope::core::model {
namespace {

using Complex = std::complex<double>;

/// Rounding leaves zeros at 0 about so far away.
constexpr double kAtZero = 1e-7;

/// The two eigenvalues of a 2 x 2 block.
std::array<Complex, 2> eigenvalues_of_block(const Eigen::Matrix2d& block) {
  const double half = 0.5 * (block(0, 0) - block(1, 1));
  const Complex root = std::sqrt(Complex(half * half + block(0, 1) * block(1, 0)));
  const double middle = 0.5 * (block(0, 0) + block(1, 1));
  return {middle + root, middle - root};
}

/// A companion matrix has Hessenberg form, so the first half of a general solver is saved.
std::vector<Complex> eigenvalues_of_hessenberg(const Eigen::MatrixXd& matrix) {
  Eigen::RealSchur<Eigen::MatrixXd> schur(matrix.rows());
  schur.computeFromHessenberg(matrix, matrix, false);
  const Eigen::MatrixXd& t = schur.matrixT();
  std::vector<Complex> values;
  for (Eigen::Index i = 0; i < t.rows(); ++i) {
    const bool pair = i + 1 < t.rows() && t(i + 1, i) != 0.0;
    if (!pair) {
      values.emplace_back(t(i, i));
      continue;
    }
    const auto both = eigenvalues_of_block(t.block<2, 2>(i, i));
    values.insert(values.end(), both.begin(), both.end());
    ++i;
  }
  return values;
}

}  // namespace

std::vector<Complex> zeros(const Polynomial& polynomial) {
  Polynomial p = polynomial;
  while (p.size() > 1 && p.back() == 0.0) p.pop_back();
  const auto n = static_cast<Eigen::Index>(p.size()) - 1;
  if (n < 1) return {};
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  for (Eigen::Index i = 0; i < n; ++i) companion(0, i) = -p[static_cast<std::size_t>(i) + 1] / p[0];
  std::vector<Complex> result = eigenvalues_of_hessenberg(companion);
  std::erase_if(result, [](const Complex& z) { return std::abs(z) < kAtZero; });
  return result;
}

}  // namespace loopscope::core::model
