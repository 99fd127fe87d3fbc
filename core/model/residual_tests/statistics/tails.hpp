#pragma once

#include <cstddef>

namespace loopscope::core::model {

/// Probability that a chi-square variable with `freedom` degrees (>= 1) exceeds `value`.
[[nodiscard]] double chi_square_p(double value, std::size_t freedom);

/// Probability that the largest distance of a Brownian bridge from 0 exceeds `value` (Kolmogorov).
[[nodiscard]] double bridge_upper(double value);

/// Probability that the largest of `count` independent exponential variables holds at least this
/// share of their sum (Fisher 1929), by its first term: exact where it is small, never below.
[[nodiscard]] double largest_share_upper(double share, std::size_t count);

}  // namespace loopscope::core::model
