#include "daemon/text/written_time.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <date/date.h>

#include "storage/timestamp.hpp"

namespace loopscope::daemon {
namespace {

/// Takes a time apart from the front. (date::parse converts seconds that it never read where a text
/// has none: undefined, and here every text is tried.)
class TimeReader {
 public:
  explicit TimeReader(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return text_.empty(); }

  /// The text that is left.
  [[nodiscard]] std::string_view rest() const { return text_; }

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

std::optional<std::chrono::microseconds> date_of(int year, int month, int day) {
  const date::year_month_day date{date::year{year}, date::month{static_cast<unsigned>(month)},
                                  date::day{static_cast<unsigned>(day)}};
  if (!date.ok()) return std::nullopt;
  return date::local_days{date}.time_since_epoch();
}

/// The three numbers of a date with one of these between them, and which it was.
struct DateNumbers {
  std::array<int, 3> numbers{};
  char between = '\0';
  bool year_first = false;  ///< the first number has four digits; else the last one has
};

std::optional<DateNumbers> read_numbers(TimeReader& reader, std::string_view any_of) {
  DateNumbers date;
  std::array<std::size_t, 3> digits{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0 && !reader.take(k == 1 ? any_of : std::string_view(&date.between, 1)))
      return std::nullopt;
    if (k == 1) date.between = reader.last();
    const std::size_t before = reader.rest().size();
    const auto number = reader.number(4, 9999);
    if (!number) return std::nullopt;
    date.numbers.at(k) = *number;
    digits.at(k) = before - reader.rest().size();
  }
  date.year_first = digits[0] == 4;
  const bool sound =
      digits[1] <= 2 && (date.year_first ? digits[2] <= 2 : digits[0] <= 2 && digits[2] == 4);
  return sound ? std::optional(date) : std::nullopt;
}

std::optional<std::chrono::microseconds> read_date(TimeReader& reader) {
  const auto year = reader.number(4, 9999);
  if (!year || !reader.take("-")) return std::nullopt;
  const auto month = reader.number(2, 12);
  if (!month || !reader.take("-")) return std::nullopt;
  const auto day = reader.number(2, 31);
  return day ? date_of(*year, *month, *day) : std::nullopt;
}

constexpr std::string_view kBetweenNumbers = "./-";

std::optional<std::chrono::microseconds> read_date(TimeReader& reader, DateOrder order) {
  const auto date = read_numbers(reader, kBetweenNumbers);
  if (!date) return std::nullopt;
  const auto& [a, b, c] = date->numbers;
  if (date->year_first) return date_of(a, b, c);
  return order == DateOrder::day_first ? date_of(c, b, a) : date_of(c, a, b);
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

/// "12:00", "12:00:00", "12:00:00.5", with one of `points` before the fraction.
std::optional<std::chrono::microseconds> read_clock(TimeReader& reader, std::string_view points) {
  const auto hour = reader.number(2, 23);
  if (!hour || !reader.take(":")) return std::nullopt;
  const auto minute = reader.number(2, 59);
  if (!minute) return std::nullopt;
  std::chrono::microseconds clock = std::chrono::hours(*hour) + std::chrono::minutes(*minute);
  if (!reader.take(":")) return clock;
  const auto second = reader.number(2, 59);
  if (!second) return std::nullopt;
  clock += std::chrono::seconds(*second);
  if (!reader.take(points)) return clock;
  const auto fraction = read_fraction(reader);
  return fraction ? std::optional(clock + *fraction) : std::nullopt;
}

/// How far the clock is ahead of UTC: "Z", "+01", "+01:00", "-0500".
std::optional<std::chrono::microseconds> read_offset(TimeReader& reader) {
  if (reader.take("Z")) return std::chrono::minutes(0);
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

/// A clock of twelve hours becomes one of twenty-four where AM or PM stands behind it.
bool read_half_of_day(TimeReader& reader, std::chrono::microseconds& clock) {
  TimeReader behind = reader;
  while (behind.take(" ")) {
  }
  if (!behind.take("AaPp")) return true;
  const bool afternoon = behind.last() == 'P' || behind.last() == 'p';
  if (!behind.take("Mm")) return false;
  const auto hour = std::chrono::duration_cast<std::chrono::hours>(clock).count();
  if (hour < 1 || hour > 12) return false;
  if (hour == 12) clock -= std::chrono::hours(12);
  if (afternoon) clock += std::chrono::hours(12);
  reader = behind;
  return true;
}

/// What stands behind a date: nothing, or a clock and perhaps its offset.
template <typename ReadClock>
std::optional<WrittenTime> read_behind(TimeReader& reader,
                                       const std::optional<std::chrono::microseconds>& day,
                                       ReadClock read_time_of_day) {
  if (!day) return std::nullopt;
  WrittenTime time{day->count(), std::nullopt, reader.at_end()};
  if (!time.day_alone) {
    if (!reader.take("T ")) return std::nullopt;
    const std::optional<std::chrono::microseconds> clock = read_time_of_day(reader);
    if (!clock) return std::nullopt;
    time.clock_us += clock->count();
  }
  if (!reader.at_end()) {
    const auto offset = read_offset(reader);
    if (!offset || !reader.at_end()) return std::nullopt;
    time.offset_us = offset->count();
  }
  return storable(time.clock_us - time.offset_us.value_or(0)) ? std::optional(time) : std::nullopt;
}

}  // namespace

std::optional<WrittenTime> parse_time(std::string_view text) {
  TimeReader reader(text);
  const auto day = read_date(reader);
  return read_behind(reader, day, [](TimeReader& clock) { return read_clock(clock, "."); });
}

std::optional<WrittenTime> parse_time(std::string_view text, DateOrder order) {
  TimeReader reader(text);
  const auto day = read_date(reader, order);
  return read_behind(reader, day, [](TimeReader& at) -> std::optional<std::chrono::microseconds> {
    auto clock = read_clock(at, ".,");
    return clock && read_half_of_day(at, *clock) ? clock : std::nullopt;
  });
}

DateForm date_form(std::string_view text) {
  TimeReader reader(text);
  const auto date = read_numbers(reader, kBetweenNumbers);
  if (!date || date->year_first) return DateForm::other;
  return date->between == '.' ? DateForm::dotted : DateForm::ambiguous;
}

bool storable(std::int64_t time_us) {
  return time_us >= storage::kEarliestTimeUs && time_us <= storage::kLatestTimeUs;
}

}  // namespace loopscope::daemon
