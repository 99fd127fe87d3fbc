#include "core/model/residual_tests/statistics/linear_span.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace loopscope::core::model {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd products_of(const MatrixXd& columns) {
  MatrixXd products = MatrixXd::Zero(columns.cols(), columns.cols());
  products.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
  return products;
}

/// One over the length of each column; 0 where it is zero.
VectorXd scales(const MatrixXd& products) {
  VectorXd scale(products.cols());
  for (Index j = 0; j < scale.size(); ++j)
    scale[j] = products(j, j) > 0.0 ? 1.0 / std::sqrt(products(j, j)) : 0.0;
  return scale;
}

/// R with R' P R = I for products P (lower triangle) of columns of length 1, by Cholesky's factors:
/// of the columns that are left, the one that adds most comes next, and none that adds nothing.
/// Eigen's own (LDLT) goes by the lengths of the columns, not by what they add.
MatrixXd root_of(const MatrixXd& products) {
  const Index columns = products.cols();
  const MatrixXd all = products.selfadjointView<Eigen::Lower>();
  VectorXd added = products.diagonal();
  MatrixXd factors(columns, 0);
  std::vector<Index> chosen;
  for (Index next = 0; added.maxCoeff(&next) > kLeastLeft;) {
    const Index rank = factors.cols();
    VectorXd factor = all.col(next) - factors * factors.row(next).transpose();
    factor /= std::sqrt(added[next]);
    added -= factor.cwiseAbs2();
    added[next] = 0.0;
    factors.conservativeResize(Eigen::NoChange, rank + 1);
    factors.col(rank) = factor;
    chosen.push_back(next);
  }
  const MatrixXd upper = factors(chosen, Eigen::all).transpose();
  MatrixXd inverse = MatrixXd::Identity(upper.rows(), upper.cols());
  upper.triangularView<Eigen::Upper>().solveInPlace(inverse);
  MatrixXd root = MatrixXd::Zero(columns, inverse.cols());
  root(chosen, Eigen::all) = inverse;
  return root;
}

/// The same of columns of any length.
MatrixXd scaled_root_of(const MatrixXd& products) {
  const VectorXd scale = scales(products);
  return scale.asDiagonal() * root_of(scale.asDiagonal() * products * scale.asDiagonal());
}

}  // namespace

void LaggedColumns::add(std::span<const double> signal, std::span<const int> lags) {
  for (const int lag : lags) columns_.push_back({signal, lag});
}

MatrixXd LaggedColumns::block(Index first_row, Index rows) const {
  MatrixXd result(rows, columns());
  for (Index j = 0; j < columns(); ++j) {
    const auto& [signal, lag] = columns_[static_cast<std::size_t>(j)];
    const Index zeros = std::clamp(lag - first_row, Index{0}, rows);
    result.col(j).head(zeros).setZero();
    std::copy_n(signal.data() + (first_row + zeros - lag), rows - zeros,
                result.col(j).data() + zeros);
  }
  return result;
}

LinearSpan::LinearSpan(const LaggedColumns& columns, const ArrayXd& recorded)
    : columns_(columns.rows(), columns.columns() + 1) {
  columns_.col(0) = recorded.matrix();
  columns_.rightCols(columns.columns()) =
      recorded.matrix().asDiagonal() * columns.block(0, columns.rows());
  root_ = scaled_root_of(products_of(columns_));
}

LinearSpan::LinearSpan(const LinearSpan& known, const LaggedColumns& columns,
                       const ArrayXd& recorded)
    : columns_(columns.rows(), known.columns() + columns.columns()) {
  columns_ << known.columns_, recorded.matrix().asDiagonal() * columns.block(0, columns.rows());
  root_ = scaled_root_of(products_of(columns_));
}

VectorXd LinearSpan::without(std::span<const double> signal) const {
  const Eigen::Map<const VectorXd> y(signal.data(), static_cast<Index>(signal.size()));
  return y - columns_ * coefficients(columns_.transpose() * y);
}

}  // namespace loopscope::core::model
