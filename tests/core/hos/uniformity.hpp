#pragma once

#include <vector>

namespace loopscope::core::hos::tests {

/// Kolmogorov's distance of `p` from a uniform law on (0, 1), times the root of their number. 1.95
/// is exceeded once in a thousand samples of a uniform law, 2.23 once in ten thousand.
[[nodiscard]] double distance_from_uniform(std::vector<double> p);

/// Exceeded by distance_from_uniform once in ten thousand uniform samples.
inline constexpr double kLargestDistance = 2.23;

/// Share of `p` at or below `level`.
[[nodiscard]] double share_below(const std::vector<double>& p, double level);

}  // namespace loopscope::core::hos::tests
