#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/text/written_time.hpp"

namespace loopscope::daemon {

/// What a column of a recording may be: a time as date and clock, or in seconds; the signals.
inline constexpr std::array<std::string_view, 8> kColumnRoles = {"time", "t_s", "sp",   "pv",
                                                                 "op",   "mv",  "mode", "quality"};

/// What is said of a file that it does not show itself; all of it may be left out.
struct RecordingForm {
  /// The header's name of a column by its role (kColumnRoles).
  std::map<std::string, std::string, std::less<>> columns = {};
  std::optional<char> decimal_sign =
      std::nullopt;  ///< '.' or ','; nullopt = as the numbers show it
  std::optional<DateOrder> date_order =
      std::nullopt;  ///< of dates that begin with day or month; nullopt = unsaid
};

/// "pv=PV_Actual,sp=W" as RecordingForm::columns; a piece without a role belongs to the name before
/// it. Throws Failure (usage): an unknown role, one that stands twice, a name that is empty.
[[nodiscard]] std::map<std::string, std::string, std::less<>> parse_columns(std::string_view text);

}  // namespace loopscope::daemon
