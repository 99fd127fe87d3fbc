#pragma once

#include <cstdint>
#include <string>

#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// Seconds since 1970, as points of a time axis carry them.
[[nodiscard]] double seconds_of(std::int64_t time_us);

/// The x axis as times from `from_us` to `to_us` (microseconds UTC since 1970): range, tics at
/// round times of the zone's clock, and a label that names days and zone. Equal lengths are equal
/// times: where the clock is changed within the axis, an hour of it is left out or stands twice,
/// and every time of day says which clock it is of.
[[nodiscard]] std::string time_axis(std::int64_t from_us, std::int64_t to_us, const TimeZone& zone);
/// The same without words, for the upper ones of panels that share an axis.
[[nodiscard]] std::string silent_time_axis(std::int64_t from_us, std::int64_t to_us,
                                           const TimeZone& zone);

}  // namespace loopscope::daemon
