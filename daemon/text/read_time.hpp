#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "daemon/text/time_zone.hpp"
#include "daemon/text/written_time.hpp"

namespace loopscope::daemon {

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

/// The same of a time that was taken apart; nullopt = it is none.
[[nodiscard]] std::variant<std::int64_t, TimeProblem> read_time(
    const std::optional<WrittenTime>& time, const TimeZone& zone);

/// The value of a command's option, e.g. "--since". Throws Failure (usage) with the problem.
[[nodiscard]] std::int64_t time_option(std::string_view option, const std::string& text,
                                       const TimeZone& zone);

}  // namespace loopscope::daemon
