#include "core/model/added_column.hpp"

#include "core/model/newton_step.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

AddedColumn::AddedColumn(const MatrixXd& steady_normal)
    : inverse_(steady_normal.rows() - 1, steady_normal.rows() - 1) {
  const Index terms = inverse_.rows();
  const MatrixXd regressors = steady_normal.bottomRightCorner(terms, terms);
  const VectorXd right = steady_normal.col(0).tail(terms);
  for (Index i = 0; i < terms; ++i)
    inverse_.col(i) = solve_normal(regressors, VectorXd::Unit(terms, i));
  const VectorXd diagonal = regressors.diagonal(), coefficients = inverse_ * right;
  diagonal_.assign(diagonal.begin(), diagonal.end());
  coefficients_.assign(coefficients.begin(), coefficients.end());
  squares_ = steady_normal(0, 0) - coefficients.dot(right);
}

double AddedColumn::squares_left(std::span<const double> moved) const {
  const std::span<const double> shared = moved.subspan(1, diagonal_.size());
  const double own = moved.back();
  double pivot = own * (1.0 + kRidge) + kPrior, right = moved.front();
  const auto reduced = [&](std::size_t i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < shared.size(); ++j)
      sum += inverse_(static_cast<Index>(i), static_cast<Index>(j)) * shared[j];
    return sum;
  };
  for (std::size_t i = 0; i < shared.size(); ++i) {
    pivot -= shared[i] * reduced(i);
    right -= shared[i] * coefficients_[i];
  }
  const double added = right / pivot;
  double ridge = own * added * added;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const double coefficient = coefficients_[i] - added * reduced(i);
    ridge += diagonal_[i] * coefficient * coefficient;
  }
  return squares_ - added * right - kRidge * ridge;
}

}  // namespace loopscope::core::model
