#pragma once

#include <cmath>
#include <cstdint>

namespace loopscope::core::signal {

/// Times of rows and slots are whole microseconds since 1970, UTC; spans in settings are seconds.
inline constexpr double kMicrosecondsPerSecond = 1e6;
inline constexpr std::int64_t kSecond_us = 1'000'000;

/// The nearest whole microsecond. `seconds` is finite, its size below 9.2e12.
[[nodiscard]] inline std::int64_t microseconds(double seconds) {
  return std::llround(seconds * kMicrosecondsPerSecond);
}

}  // namespace loopscope::core::signal
