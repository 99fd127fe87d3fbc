#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::hos {

/// What an autoregressive model does not predict of a record, kept up to date while samples of the
/// record are changed: the likelihood of the record under the model, piece by piece.
///
/// From the sample of number `order` of each unbroken piece on these are the errors of prediction
/// from the samples before; for the first ones, which have no such prediction, from the samples
/// behind.
class PredictionErrors {
 public:
  /// x(t) = a_1 x(t-1) + ... about `mean`; NaN separates the pieces of the record.
  PredictionErrors(std::span<const double> record, std::span<const double> coefficients,
                   double mean);

  /// Mean square of the errors of prediction from the samples before, in the record's unit squared;
  /// 0 when there are none.
  [[nodiscard]] double variance() const;

  /// Half the sum of squares as a function of the samples first, first + 1, ...: its gradient, and
  /// the lower triangle of its second derivatives. Both have the size of the run.
  void expand(std::size_t first, Eigen::VectorXd& gradient, Eigen::MatrixXd& curvature) const;

  /// The samples first, first + 1, ... of the record have been raised by `change`.
  void change(std::size_t first, const Eigen::VectorXd& change);

 private:
  struct Row;
  template <typename Visit>
  void visit_rows(std::size_t first, std::size_t count, Visit visit) const;
  /// Whether the samples lie deep inside an unbroken piece: every error that they enter is one of
  /// prediction from the samples before.
  [[nodiscard]] bool is_inside(std::size_t first, std::size_t count) const;
  void expand_inside(std::size_t first, Eigen::VectorXd& gradient,
                     Eigen::MatrixXd& curvature) const;
  [[nodiscard]] std::size_t order() const { return weights_.size() - 1; }

  std::vector<double> weights_;   // 1, -a_1, -a_2, ...
  std::vector<double> products_;  // sum over i of weight i times weight i + lag
  std::vector<double> forward_;   // NaN = no prediction
  std::vector<double> backward_;  // NaN = no prediction, or the forward one exists
};

}  // namespace loopscope::core::hos
