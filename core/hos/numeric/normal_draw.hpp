#pragma once

#include <random>

namespace loopscope::core::hos {

/// 53 random bits to [0, 1): the same numbers on every platform, unlike the standard library's
/// distributions.
[[nodiscard]] inline double uniform_draw(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

/// One standard normal number (Marsaglia's polar method), the same on every platform.
[[nodiscard]] double normal_draw(std::mt19937_64& random);

/// One number of the normal law with this mean and standard deviation (> 0), given that it lies
/// within low to high (low <= high; either may be infinite), by rejection: exact, and without the
/// distribution function. More than a million standard deviations out it is the nearer limit, or
/// within a millionth of one of it.
[[nodiscard]] double normal_draw_within(double mean, double std, double low, double high,
                                        std::mt19937_64& random);

}  // namespace loopscope::core::hos
