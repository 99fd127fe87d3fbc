#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::plant {

/// Probability that independent uniform p-values have so small a product (Fisher 1932): with
/// s = - sum ln p of n of them, exp(-s) times the sum of s^k / k!, k < n.
[[nodiscard]] double fisher_p(std::span<const double> p);

/// One-sided p of Pearson's correlation being so large and positive, x and y independent, one of
/// them white: Student's t with n - 4 degrees of freedom, two having gone to the own past of each.
/// 1 with fewer than eight pairs or without variance.
[[nodiscard]] double correlation_p(std::span<const double> x, std::span<const double> y);

/// Probability of at least `hits` successes in `trials` of probability p.
[[nodiscard]] double at_least_p(std::size_t hits, std::size_t trials, double p);

}  // namespace loopscope::core::plant
