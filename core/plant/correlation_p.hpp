#pragma once

#include <span>

namespace loopscope::core::plant {

/// One-sided p of Pearson's correlation of x and y (finite, of equal length) so large and positive,
/// were they independent and one of them white, by Student's t with n - 2 - `freedom_lost` degrees
/// of freedom: those that went to what was fitted to x and y before. 1 with fewer than eight pairs
/// or without variance.
[[nodiscard]] double correlation_p(std::span<const double> x, std::span<const double> y,
                                   double freedom_lost);

/// Probability that independent uniform p-values have so small a product (Fisher 1932), for at
/// least one of them.
[[nodiscard]] double fisher_combined_p(std::span<const double> p);

}  // namespace loopscope::core::plant
