#pragma once

#include <cstddef>

namespace loopscope::core::model {

/// Probability that a chi-square variable with `freedom` degrees (>= 1) exceeds `value`.
[[nodiscard]] double chi_square_p(double value, std::size_t freedom);

/// Probability that the largest distance of a Brownian bridge from 0 exceeds `value` (Kolmogorov);
/// 1 for a value up to 0.3, where it differs from that by less than 1e-5.
[[nodiscard]] double bridge_upper(double value);

/// Probability that the largest of `count` independent exponential variables holds at least this
/// share (0 to 1) of their sum (Fisher 1929), by its first term: exact where it is small, never
/// below. 1 for fewer than two.
[[nodiscard]] double largest_share_upper(double share, std::size_t count);

}  // namespace loopscope::core::model
