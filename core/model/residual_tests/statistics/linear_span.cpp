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

/// From column to column in memory. Columns of 4096 rows one behind the other begin at multiples of
/// 32 kB, and as many as there are here drive each other out of the processor's caches, which put
/// all such addresses into the same few places: here each begins 17 lines of 64 bytes further on
/// than the one before, whatever the number of rows.
Index spacing_of(Index rows) {
  constexpr Index kPage = 512, kFurther = 136;
  const Index beyond = rows % kPage;
  return rows + kFurther - beyond + (beyond > kFurther ? kPage : 0);
}

/// Of the columns from `first` on with all of them, a row each.
MatrixXd products_of(const MatrixXd& columns, Index rows_used, Index first) {
  SumTable sums = SumTable::Zero(columns.cols() - first, columns.cols());
  const std::vector<Signal> all = columns_of(columns);
  for_blocks(rows_used, [&](const Range& rows) {
    add_products(std::span(all).subspan(static_cast<std::size_t>(first)), all, rows, sums);
  });
  return sums;
}

/// One over the length of each column; 0 where it is zero.
VectorXd scales(const MatrixXd& products) {
  VectorXd scale(products.cols());
  for (Index j = 0; j < scale.size(); ++j)
    scale[j] = products(j, j) > 0.0 ? 1.0 / std::sqrt(products(j, j)) : 0.0;
  return scale;
}

/// R with R' P R = I for products P of columns of length 1, by Cholesky's factors:
/// of the columns that are left, the one that adds most comes next, and none that adds nothing.
/// Eigen's own (LDLT) goes by the lengths of the columns, not by what they add.
MatrixXd root_of(const MatrixXd& products) {
  const Index columns = products.cols();
  VectorXd added = products.diagonal();
  MatrixXd factors(columns, 0);
  std::vector<Index> chosen;
  for (Index next = 0; added.maxCoeff(&next) > kLeastLeft;) {
    const Index rank = factors.cols();
    VectorXd factor = products.col(next) - factors * factors.row(next).transpose();
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

MatrixXd LaggedColumns::block(const Range& range, const ArrayXd& recorded) const {
  const auto first_row = static_cast<Index>(range.first), rows = static_cast<Index>(range.size());
  MatrixXd result(rows, columns());
  for (Index j = 0; j < columns(); ++j) {
    const auto& [signal, lag] = columns_[static_cast<std::size_t>(j)];
    const Index zeros = std::clamp(lag - first_row, Index{0}, rows);
    const Eigen::Map<const ArrayXd> later(signal.data() + (first_row + zeros - lag), rows - zeros);
    result.col(j).head(zeros).setZero();
    result.col(j).tail(rows - zeros) = recorded.segment(first_row + zeros, rows - zeros) * later;
  }
  return result;
}

void add_products(std::span<const Signal> left, std::span<const Signal> right, const Range& rows,
                  SumTable& sums) {
  best_row_kernel().add_products(left, right, {&rows, 1}, sums.data(), right.size());
}

LinearSpan::LinearSpan(const LaggedColumns& columns, const ArrayXd& recorded)
    : rows_(columns.rows()), columns_(spacing_of(rows_), columns.columns() + 1) {
  columns_.col(0).head(rows_) = recorded.matrix();
  take(columns, recorded);
}

LinearSpan::LinearSpan(const LinearSpan& known, const LaggedColumns& columns,
                       const ArrayXd& recorded)
    : rows_(known.rows_),
      columns_(spacing_of(rows_), known.columns() + columns.columns()),
      products_(known.products_) {
  columns_.topLeftCorner(rows_, known.columns()) = known.columns_.topRows(rows_);
  take(columns, recorded);
}

/// Behind the columns that are known with their products.
void LinearSpan::take(const LaggedColumns& columns, const ArrayXd& recorded) {
  columns_.topRightCorner(rows_, columns.columns()) =
      columns.block({0, static_cast<std::size_t>(columns.rows())}, recorded);
  const Index first = products_.cols();
  const MatrixXd added = products_of(columns_, rows_, first);
  products_.conservativeResize(columns_.cols(), columns_.cols());
  products_.bottomRows(added.rows()) = added;
  products_.topRightCorner(first, added.rows()) = added.leftCols(first).transpose();
  root_ = scaled_root_of(products_);
}

VectorXd LinearSpan::without(std::span<const double> signal) const {
  const std::vector<Signal> columns = columns_of(columns_);
  const Signal one = signal.data();
  SumTable products = SumTable::Zero(columns_.cols(), 1);
  add_products(columns, {&one, 1}, {0, signal.size()}, products);
  const VectorXd explained = coefficients(products);
  VectorXd left = Eigen::Map<const VectorXd>(signal.data(), static_cast<Index>(signal.size()));
  double* const from = left.data();
  best_row_kernel().subtract(columns, explained.data(), signal.size(), {&from, 1});
  return left;
}

}  // namespace loopscope::core::model
