#include "daemon/text/time_text.hpp"

#include <chrono>
#include <date/date.h>

#include "storage/timestamp.hpp"

namespace loopscope::daemon {
namespace {

using Microseconds = date::sys_time<std::chrono::microseconds>;

/// Takes a time apart from the front. (date::parse converts seconds that it never read where a text
/// has none: undefined, and here every text is tried.)
class TimeReader {
 public:
  explicit TimeReader(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return text_.empty(); }

  bool take(std::string_view any_of) {
    if (text_.empty() || any_of.find(text_.front()) == std::string_view::npos) return false;
    last_ = text_.front();
    text_.remove_prefix(1);
    return true;
  }

  /// What take() has taken.
  [[nodiscard]] char last() const { return last_; }

  /// A whole number of 1 to `most` digits, at most `largest`; nullopt for anything else.
  std::optional<int> number(std::size_t most, int largest) {
    std::size_t digits = 0;
    int value = 0;
    for (; digits < most && take("0123456789"); ++digits) value = 10 * value + (last_ - '0');
    return digits > 0 && value <= largest ? std::optional(value) : std::nullopt;
  }

 private:
  std::string_view text_;
  char last_ = '\0';
};

std::optional<Microseconds> read_date(TimeReader& reader) {
  const auto year = reader.number(4, 9999);
  if (!year || !reader.take("-")) return std::nullopt;
  const auto month = reader.number(2, 12);
  if (!month || !reader.take("-")) return std::nullopt;
  const auto day = reader.number(2, 31);
  if (!day) return std::nullopt;
  const date::year_month_day date{date::year{*year}, date::month{static_cast<unsigned>(*month)},
                                  date::day{static_cast<unsigned>(*day)}};
  return date.ok() ? std::optional<Microseconds>(date::sys_days{date}) : std::nullopt;
}

/// The digits behind the decimal point, at most six.
std::optional<std::chrono::microseconds> read_fraction(TimeReader& reader) {
  std::int64_t value = 0;
  int digits = 0;
  for (; digits < 6 && reader.take("0123456789"); ++digits)
    value = 10 * value + (reader.last() - '0');
  if (digits == 0) return std::nullopt;
  for (; digits < 6; ++digits) value *= 10;
  return std::chrono::microseconds(value);
}

/// "12:00", "12:00:00", "12:00:00.5".
std::optional<std::chrono::microseconds> read_clock(TimeReader& reader) {
  const auto hour = reader.number(2, 23);
  if (!hour || !reader.take(":")) return std::nullopt;
  const auto minute = reader.number(2, 59);
  if (!minute) return std::nullopt;
  std::chrono::microseconds clock = std::chrono::hours(*hour) + std::chrono::minutes(*minute);
  if (!reader.take(":")) return clock;
  const auto second = reader.number(2, 59);
  if (!second) return std::nullopt;
  clock += std::chrono::seconds(*second);
  if (!reader.take(".")) return clock;
  const auto fraction = read_fraction(reader);
  return fraction ? std::optional(clock + *fraction) : std::nullopt;
}

/// How far the clock is ahead of UTC: "Z", "+01", "+01:00", "-0500"; none where nothing is said.
std::optional<std::chrono::minutes> read_offset(TimeReader& reader) {
  if (reader.at_end() || reader.take("Z")) return std::chrono::minutes(0);
  if (!reader.take("+-")) return std::nullopt;
  const int sign = reader.last() == '-' ? -1 : 1;
  const auto hours = reader.number(2, 23);
  if (!hours) return std::nullopt;
  const bool colon = reader.take(":");
  if (!colon && reader.at_end()) return sign * std::chrono::hours(*hours);
  const auto minutes = reader.number(2, 59);
  if (!minutes) return std::nullopt;
  return sign * (std::chrono::hours(*hours) + std::chrono::minutes(*minutes));
}

/// The database would clip any other time without a word.
std::optional<std::int64_t> storable(std::int64_t time_us) {
  const bool held = time_us >= storage::kEarliestTimeUs && time_us <= storage::kLatestTimeUs;
  return held ? std::optional(time_us) : std::nullopt;
}

}  // namespace

std::optional<std::int64_t> parse_time(std::string_view text) {
  TimeReader reader(text);
  const auto day = read_date(reader);
  if (!day) return std::nullopt;
  if (reader.at_end()) return storable(day->time_since_epoch().count());
  if (!reader.take("T ")) return std::nullopt;
  const auto clock = read_clock(reader);
  if (!clock) return std::nullopt;
  const auto offset = read_offset(reader);
  if (!offset || !reader.at_end()) return std::nullopt;
  return storable((*day + *clock - *offset).time_since_epoch().count());
}

bool names_zone(std::string_view text) {
  const std::size_t clock = text.find_first_of("T ");
  return clock != std::string_view::npos &&
         text.find_first_of("Z+-", clock) != std::string_view::npos;
}

std::string format_time(std::int64_t time_us) {
  const Microseconds time{std::chrono::microseconds(time_us)};
  const auto seconds = date::floor<std::chrono::seconds>(time);
  return seconds == time ? date::format("%FT%TZ", seconds) : date::format("%FT%TZ", time);
}

}  // namespace loopscope::daemon
