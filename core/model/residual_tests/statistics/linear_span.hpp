#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/response/products.hpp"

namespace loopscope::core::model {

/// Columns of a regression, each a signal at some lag. The signals must outlive it; none is copied,
/// since records of some 30 kB a column would leave the processor's cache.
class LaggedColumns {
 public:
  explicit LaggedColumns(std::size_t samples) : samples_(samples) {}

  /// `signal` at each lag (>= 0); 0 where the lag reaches before the record.
  void add(std::span<const double> signal, std::span<const int> lags);

  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(samples_); }
  [[nodiscard]] Eigen::Index columns() const { return static_cast<Eigen::Index>(columns_.size()); }
  /// Some rows of them, 0 where `recorded` (of all rows) is.
  [[nodiscard]] Eigen::MatrixXd block(const Range& range, const Eigen::ArrayXd& recorded) const;

 private:
  struct Column {
    std::span<const double> signal;
    Eigen::Index lag = 0;
  };
  std::size_t samples_;
  std::vector<Column> columns_;
};

/// Of a column of which the others leave less than this share of its square rounding is left.
inline constexpr double kLeastLeft = 1e-10;

/// Sums of products, row by row in memory.
using SumTable = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Adds the products over some rows of each signal of `left` with each of `right`.
void add_products(std::span<const Signal> left, std::span<const Signal> right, const Range& rows,
                  SumTable& sums);

/// Rows that are worked on at a time: sixty columns of them stay in the processor's cache.
inline constexpr std::size_t kRowsTogether = 128;

template <class Work>
void for_blocks(Eigen::Index rows, Work work) {
  const auto all = static_cast<std::size_t>(rows);
  for (std::size_t row = 0; row < all; row += kRowsTogether)
    work(Range{row, std::min(row + kRowsTogether, all)});
}

/// All that a constant and lagged signals explain over the recorded samples: the columns K as they
/// are and a root R of the inverse of their products, (K R)'(K R) = I. Without the orthonormal
/// basis K R itself, which would cost twice as much as the products.
class LinearSpan {
 public:
  LinearSpan() = default;  ///< of no rows: to be assigned
  /// `recorded` = 1 where a sample is and 0 elsewhere, one per row.
  LinearSpan(const LaggedColumns& columns, const Eigen::ArrayXd& recorded);
  /// What `known` and the columns explain together. The same samples are recorded.
  LinearSpan(const LinearSpan& known, const LaggedColumns& columns, const Eigen::ArrayXd& recorded);

  /// Columns that say something beyond the others; what they leave of theirs is more than rounding.
  [[nodiscard]] Eigen::Index rank() const { return root_.cols(); }
  [[nodiscard]] Eigen::Index columns() const { return columns_.cols(); }
  /// K of some rows, 0 where nothing is recorded. A view of this span.
  [[nodiscard]] auto rows(const Range& some) const& {
    return columns_.middleRows(static_cast<Eigen::Index>(some.first),
                               static_cast<Eigen::Index>(some.size()));
  }
  /// The coefficients of K that explain most of signals y, of which `products` = K'y.
  [[nodiscard]] Eigen::MatrixXd coefficients(const Eigen::MatrixXd& products) const {
    return root_ * (root_.transpose() * products);
  }
  /// A signal less what is explained of it, 0 where nothing is recorded; it has to be 0 there.
  [[nodiscard]] Eigen::VectorXd without(std::span<const double> signal) const;

 private:
  void take(const LaggedColumns& columns, const Eigen::ArrayXd& recorded);

  Eigen::Index rows_ = 0;
  Eigen::MatrixXd columns_;   ///< K in its first rows, then some that are not in use
  Eigen::MatrixXd products_;  ///< of K with itself
  Eigen::MatrixXd root_;      ///< R
};

}  // namespace loopscope::core::model
