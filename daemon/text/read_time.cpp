#include "daemon/text/read_time.hpp"

#include <chrono>
#include <date/date.h>
#include <fmt/format.h>
#include <vector>

#include "daemon/text/failure.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::daemon {
namespace {

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

std::optional<std::chrono::microseconds> read_date(TimeReader& reader) {
  const auto year = reader.number(4, 9999);
  if (!year || !reader.take("-")) return std::nullopt;
  const auto month = reader.number(2, 12);
  if (!month || !reader.take("-")) return std::nullopt;
  const auto day = reader.number(2, 31);
  if (!day) return std::nullopt;
  const date::year_month_day date{date::year{*year}, date::month{static_cast<unsigned>(*month)},
                                  date::day{static_cast<unsigned>(*day)}};
  if (!date.ok()) return std::nullopt;
  return date::local_days{date}.time_since_epoch();
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

/// The database would clip any other time without a word.
bool storable(std::int64_t time_us) {
  return time_us >= storage::kEarliestTimeUs && time_us <= storage::kLatestTimeUs;
}

TimeProblem not_a_time() {
  return {"is not a time", "write ISO 8601 in the years 1 to 9999, e.g. 2026-03-01T12:00:00Z"};
}

/// "02:00 CET"
std::string clock_words(std::int64_t time_us, const TimeZone::Period& period) {
  const date::local_time<std::chrono::microseconds> clock{
      std::chrono::microseconds(time_us + period.offset_us)};
  return date::format("%H:%M ", date::floor<std::chrono::minutes>(clock)) + period.words;
}

/// "from 02:00 CET to 03:00 CEST"
std::string change_words(std::int64_t change_us, const TimeZone& zone) {
  return fmt::format("from {} to {}", clock_words(change_us, zone.period_at(change_us - 1)),
                     clock_words(change_us, zone.period_at(change_us)));
}

TimeProblem never_was(const WrittenTime& time, std::int64_t change_us, const TimeZone& zone) {
  const std::int64_t after_us = time.clock_us - zone.period_at(change_us - 1).offset_us;
  return {fmt::format("is not a time in {}: the clock was put forward {} then", zone.name(),
                      change_words(change_us, zone)),
          "write the time that the clock showed, with its offset: " + format_time(after_us, zone)};
}

TimeProblem was_twice(const TimeZone::Moments& moments, const TimeZone& zone) {
  const auto choice = [&](std::int64_t time_us) {
    return fmt::format("{} ({})", format_time(time_us, zone), zone.period_at(time_us).words);
  };
  return {fmt::format("is two times in {}: the clock was put back {} then", zone.name(),
                      change_words(moments.change_us, zone)),
          fmt::format("write the offset: {} or {}", choice(moments.times_us.front()),
                      choice(moments.times_us.back()))};
}

/// The first of several; of none, where the day begins with the change.
std::int64_t first_moment(const TimeZone::Moments& moments) {
  return moments.times_us.empty() ? moments.change_us : moments.times_us.front();
}

}  // namespace

std::optional<WrittenTime> parse_time(std::string_view text) {
  TimeReader reader(text);
  const auto day = read_date(reader);
  if (!day) return std::nullopt;
  WrittenTime time{day->count(), std::nullopt, reader.at_end()};
  if (!time.day_alone) {
    if (!reader.take("T ")) return std::nullopt;
    const auto clock = read_clock(reader);
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

std::variant<std::int64_t, TimeProblem> read_time(std::string_view text, const TimeZone& zone) {
  const auto time = parse_time(text);
  if (!time) return not_a_time();
  if (time->offset_us) return time->clock_us - *time->offset_us;
  const TimeZone::Moments moments = zone.moments_of(time->clock_us);
  if (time->day_alone || moments.times_us.size() == 1) {
    const std::int64_t time_us = first_moment(moments);
    return storable(time_us) ? std::variant<std::int64_t, TimeProblem>(time_us) : not_a_time();
  }
  return moments.times_us.empty() ? never_was(*time, moments.change_us, zone)
                                  : was_twice(moments, zone);
}

std::int64_t time_option(std::string_view option, const std::string& text, const TimeZone& zone) {
  const auto read = read_time(text, zone);
  if (const auto* time_us = std::get_if<std::int64_t>(&read)) return *time_us;
  const auto& problem = std::get<TimeProblem>(read);
  throw Failure(ExitCode::usage, fmt::format("{} \"{}\" {}", option, text, problem.what),
                problem.hint);
}

}  // namespace loopscope::daemon
