#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

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

/// In which order a date says day and month that ends with its year.
enum class DateOrder { day_first, month_first };

/// What spreadsheets and control systems write beside ISO 8601: the date as "01.03.2026",
/// "01/03/2026" or "01-03-2026" in this order, or with the year first ("2026/03/01"); a year always
/// has four digits. Behind a blank a clock, with "." or "," before fractions and AM or PM at its
/// end; an offset as in ISO 8601. nullopt as there.
[[nodiscard]] std::optional<WrittenTime> parse_time(std::string_view text, DateOrder order);

/// How the text of a time writes its date.
enum class DateForm {
  other,      ///< none of the two
  dotted,     ///< "01.03.2026": day, month, year wherever it is written
  ambiguous,  ///< "01/03/2026", "01-03-2026": by country
};
[[nodiscard]] DateForm date_form(std::string_view text);

/// Whether the database holds the time (microseconds UTC since 1970): it would clip any other one
/// without a word.
[[nodiscard]] bool storable(std::int64_t time_us);

}  // namespace loopscope::daemon
