#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// ISO 8601 date and time ("2026-03-01T12:00:00.5Z", "2026-03-01 12:00:00+01:00"; without a zone:
/// UTC; without a time of day: 0 h) in the years 1 to 9999 as microseconds UTC since 1970; nullopt
/// for anything else, more than six decimals too.
[[nodiscard]] std::optional<std::int64_t> parse_time(std::string_view text);

/// Whether a text that parse_time() accepts says its zone: Z or an offset.
[[nodiscard]] bool names_zone(std::string_view text);

/// Microseconds UTC since 1970 as ISO 8601 with Z; fractions only where there are any.
[[nodiscard]] std::string format_time(std::int64_t time_us);

}  // namespace loopscope::daemon
