#include "core/model/fit/added_column.hpp"

#include "core/model/fit/newton_step.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

AddedColumn::AddedColumn(const MatrixXd& steady_normal) {
  const Index terms = steady_normal.rows() - 1;
  const MatrixXd regressors = steady_normal.bottomRightCorner(terms, terms);
  const VectorXd right = steady_normal.col(0).tail(terms);
  inverse_ = inverse_of_normal(regressors);
  const VectorXd diagonal = regressors.diagonal(), coefficients = inverse_ * right;
  diagonal_.assign(diagonal.begin(), diagonal.end());
  coefficients_.assign(coefficients.begin(), coefficients.end());
  squares_ = steady_normal(0, 0) - coefficients.dot(right);
}

double AddedColumn::squares_left(std::span<const double> moved) {
  const std::span<const double> shared = moved.subspan(1, diagonal_.size());
  const double own = moved.back();
  double pivot = own * (1.0 + kRidge) + kPrior, right = moved.front();
  reduced_.assign(shared.size(), 0.0);
  for (std::size_t j = 0; j < shared.size(); ++j) {
    const double* column = inverse_.col(static_cast<Index>(j)).data();
    for (std::size_t i = 0; i < shared.size(); ++i) reduced_[i] += column[i] * shared[j];
  }
  for (std::size_t i = 0; i < shared.size(); ++i) {
    pivot -= shared[i] * reduced_[i];
    right -= shared[i] * coefficients_[i];
  }
  const double added = right / pivot;
  double ridge = own * added * added;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const double coefficient = coefficients_[i] - added * reduced_[i];
    ridge += diagonal_[i] * coefficient * coefficient;
  }
  return squares_ - added * right - kRidge * ridge;
}

}  // namespace loopscope::core::model
