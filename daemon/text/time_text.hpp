#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

// How times are shown, in the zone of the plant where it is said; times are microseconds UTC since
// 1970.

/// ISO 8601 with what the clock is ahead of UTC: "2026-03-01T12:00:00Z", "...T13:00:00+01:00";
/// fractions only where there are any. What read_time() reads.
[[nodiscard]] std::string format_time(std::int64_t time_us, const TimeZone& zone = {});

/// The same to the second that has begun: nobody reads microseconds.
[[nodiscard]] std::string second_in_zone(std::int64_t time_us, const TimeZone& zone);

/// "2026-03-01 12:00 UTC", "2026-03-01 13:00 CET": to the minute, for reading.
[[nodiscard]] std::string minute_in_zone(std::int64_t time_us, const TimeZone& zone);

/// The same below a heading that names the zone: UTC is not said again; elsewhere the clock
/// changes, so that one reading may stand for two times.
[[nodiscard]] std::string minute_below_zone(std::int64_t time_us, const TimeZone& zone);

/// "2026-03-01": the day at that place.
[[nodiscard]] std::string day_in_zone(std::int64_t time_us, const TimeZone& zone);

/// A sentence of the results with the times that it holds, "2026-03-01 12:00 UTC", as
/// minute_in_zone() tells them: SQL knows no other zone.
[[nodiscard]] std::string with_times_in_zone(std::string_view sentence, const TimeZone& zone);

}  // namespace loopscope::daemon
