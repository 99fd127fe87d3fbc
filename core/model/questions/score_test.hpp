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

/// An orthonormal basis of what a constant and the columns span over the samples with weight 1 (the
/// others have weight 0 and get zeros). Columns that the others already span are left out.
[[nodiscard]] Eigen::MatrixXd orthonormal(const LaggedColumns& columns,
                                          const Eigen::ArrayXd& weights);

/// The same with a basis that is there already, followed by what the columns span beyond it.
[[nodiscard]] Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& known,
                                          const LaggedColumns& columns,
                                          const Eigen::ArrayXd& weights);

/// The residual less what `known` explains of it; it holds 0 where the weight of `known` was 0.
[[nodiscard]] Eigen::VectorXd without(const Eigen::MatrixXd& known,
                                      std::span<const double> residual);

struct Score {
  double p = 1.0;
  std::size_t freedom = 0;  ///< 0 = the columns say nothing beyond `known`
  Eigen::VectorXd t;        ///< of each column alone, standard normal under the null
};

/// Is white noise r linked with columns z that are known before it? The score test robust to
/// heteroscedasticity (White 1980): with s = sum r(k) z(k) and V = sum r(k)^2 z(k) z(k)',
///
///     s' V^-1 s ~ chi-square, rank V degrees of freedom
///
/// with V times n / (n - columns of `known`), n recorded rows (MacKinnon and White 1985, HC1).
///
/// Here z is less what `known` (from orthonormal(), with the same weights) explains of it; r comes
/// from without(). One sample can never add more than its own share: outliers do not make it
/// reject.
[[nodiscard]] Score score_test(const Eigen::VectorXd& residual, const LaggedColumns& columns,
                               const Eigen::MatrixXd& known, const Eigen::ArrayXd& weights);

}  // namespace loopscope::core::model
