#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/model/residual_tests/statistics/linear_span.hpp"

namespace loopscope::core::model {

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
/// with V times n / (n - rank of `known`), n recorded rows (MacKinnon and White 1985, HC1).
///
/// Here z is less what `known` (of the same recorded rows) explains of it; r comes from its
/// without(). One sample can never add more than its own share: outliers do not make it reject.
[[nodiscard]] Score score_test(const Eigen::VectorXd& residual, const LaggedColumns& columns,
                               const LinearSpan& known, const Eigen::ArrayXd& recorded);

/// The same of `together` columns after the other `together` ones, a score each: what they share is
/// worked out once.
[[nodiscard]] std::vector<Score> score_tests(const Eigen::VectorXd& residual,
                                             const LaggedColumns& columns, Eigen::Index together,
                                             const LinearSpan& known,
                                             const Eigen::ArrayXd& recorded);

}  // namespace loopscope::core::model
