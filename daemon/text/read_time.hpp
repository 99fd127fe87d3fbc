#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// A time as it is written.
struct WrittenTime {
  std::int64_t clock_us = 0;              ///< what the clock shows, microseconds since 1970
  std::optional<std::int64_t> offset_us;  ///< how far it is ahead of UTC; nullopt = not said
  bool day_alone = false;                 ///< without a time of day, which means its beginning
};

/// ISO 8601 ("2026-03-01T12:00:00.5Z", "2026-03-01 12:00:00+01:00", "2026-03-01") in the years 1 to
/// 9999; nullopt for anything else, more than six decimals too.
[[nodiscard]] std::optional<WrittenTime> parse_time(std::string_view text);

/// Why a text is no time: "is not a time", "never was in Europe/Berlin: ...", and what to write.
struct TimeProblem {
  std::string what;  ///< the end of a sentence that begins with the text
  std::string hint;
};

/// What was written as microseconds UTC since 1970: without an offset it is meant in `zone`. A
/// reading of the local clock that never was, or was twice, is a problem; of a day without a time
/// the first moment counts.
[[nodiscard]] std::variant<std::int64_t, TimeProblem> read_time(std::string_view text,
                                                                const TimeZone& zone);

/// The value of a command's option, e.g. "--since". Throws Failure (usage) with the problem.
[[nodiscard]] std::int64_t time_option(std::string_view option, const std::string& text,
                                       const TimeZone& zone);

}  // namespace loopscope::daemon
