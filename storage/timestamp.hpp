#pragma once

#include <cstdint>
#include <string>

namespace loopscope::storage {

/// Times that PostgreSQL and every calendar of ours can express: years 1 to 9999.
inline constexpr std::int64_t kEarliestTimeUs = -62'135'596'800'000'000;
inline constexpr std::int64_t kLatestTimeUs = 253'402'300'799'999'999;

/// `time_us` (microseconds UTC since 1970), brought into the range above.
[[nodiscard]] std::int64_t clamp_time(std::int64_t time_us);

/// "2025-01-31 12:00:00.000000+00": input of timestamptz and (its zone is ignored) timestamp.
/// Times outside the range above become the nearest end.
[[nodiscard]] std::string timestamp_text(std::int64_t time_us);

}  // namespace loopscope::storage
