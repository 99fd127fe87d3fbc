#pragma once

#include <cstdint>

#include "core/signal/microseconds.hpp"

/// Times that several tests use, in microseconds since 1970, UTC.
namespace loopscope::daemon {

using core::signal::kSecond_us;
inline constexpr std::int64_t kHour_us = 3600 * kSecond_us;
inline constexpr std::int64_t kMinute_us = 60 * kSecond_us;
/// When the clock of Europe/Berlin is put forward and back.
inline constexpr std::int64_t kBerlinForward_us = 1'774'746'000'000'000;  // 2026-03-29T01:00:00Z
inline constexpr std::int64_t kBerlinBack_us = 1'792'890'000'000'000;     // 2026-10-25T01:00:00Z
inline constexpr std::int64_t kNoon_us = 1'772'366'400'000'000;           // 2026-03-01T12:00:00Z

}  // namespace loopscope::daemon
