#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace loopscope::config {

/// The zone that needs no database and is the default.
inline constexpr std::string_view kUtc = "UTC";

/// Names of the IANA time zone database as this system has it (Debian's package tzdata), sorted;
/// empty = it has none. What the system calls its own zone (`localtime`) is no name of a plant's.
[[nodiscard]] const std::vector<std::string>& time_zone_names();

/// Whether times can be told in that zone: kUtc, or one of time_zone_names().
[[nodiscard]] bool is_time_zone(std::string_view name);

/// What to write instead of a name that is no time zone, a sentence.
[[nodiscard]] std::string time_zone_hint(std::string_view name);

}  // namespace loopscope::config
