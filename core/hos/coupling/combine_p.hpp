#pragma once

#include <span>

namespace loopscope::core::hos {

/// One p-value from several tests of one hypothesis: the Cauchy combination (Liu and Xie 2020),
///
///     p = 1/2 - atan(mean of tan(pi (1/2 - p_i))) / pi
///
/// Exact for independent tests and close to it for dependent ones where p is small. One tiny p
/// among n gives n times that p, as Bonferroni's rule does; several middling ones add up, which
/// Bonferroni's rule ignores. p-values above 0.9 count as 0.9, so that one test that fits too well
/// does not hide another; that makes 5.2 % of 5 % and 1.0 % of 1 %. 0 < p_i <= 1; at least one.
[[nodiscard]] double combine_p(std::span<const double> p);

}  // namespace loopscope::core::hos
