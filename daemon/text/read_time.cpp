#include "daemon/text/read_time.hpp"

#include <chrono>
#include <date/date.h>
#include <fmt/format.h>
#include <vector>

#include "daemon/text/failure.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

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

std::variant<std::int64_t, TimeProblem> read_time(std::string_view text, const TimeZone& zone) {
  return read_time(parse_time(text), zone);
}

std::variant<std::int64_t, TimeProblem> read_time(const std::optional<WrittenTime>& time,
                                                  const TimeZone& zone) {
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
