#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

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
  [[nodiscard]] Eigen::MatrixXd block(Eigen::Index first_row, Eigen::Index rows) const;

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

/// Rows that are worked on at a time: twenty columns of them stay in the processor's cache.
inline constexpr Eigen::Index kRowsTogether = 256;

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
  [[nodiscard]] auto rows(Eigen::Index first, Eigen::Index count) const& {
    return columns_.middleRows(first, count);
  }
  /// The coefficients of K that explain most of signals y, of which `products` = K'y.
  [[nodiscard]] Eigen::MatrixXd coefficients(const Eigen::MatrixXd& products) const {
    return root_ * (root_.transpose() * products);
  }
  /// A signal less what is explained of it, 0 where nothing is recorded; it has to be 0 there.
  [[nodiscard]] Eigen::VectorXd without(std::span<const double> signal) const;

 private:
  Eigen::MatrixXd columns_;  ///< K
  Eigen::MatrixXd root_;     ///< R
};

}  // namespace loopscope::core::model
