#pragma once

#include <random>

namespace loopscope::core::hos {

/// 53 random bits to [0, 1): the same numbers on every platform, unlike the standard library's
/// distributions.
[[nodiscard]] inline double uniform_draw(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

}  // namespace loopscope::core::hos
