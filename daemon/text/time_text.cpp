#include "daemon/text/time_text.hpp"

#include <chrono>
#include <cstdlib>
#include <date/date.h>
#include <fmt/format.h>

#include "core/signal/microseconds.hpp"
#include "daemon/text/read_time.hpp"

namespace loopscope::daemon {
namespace {

using ClockTime = date::local_time<std::chrono::microseconds>;

constexpr std::int64_t kMinute_us = 60 * core::signal::kSecond_us;

ClockTime clock_time(std::int64_t clock_us) {
  return ClockTime{std::chrono::microseconds(clock_us)};
}

/// "Z", "+01:00".
std::string offset_text(const TimeZone& zone, std::int64_t offset_us) {
  if (zone.is_utc()) return "Z";
  const std::int64_t minutes = std::abs(offset_us) / kMinute_us;
  return fmt::format("{}{:02}:{:02}", offset_us < 0 ? '-' : '+', minutes / 60, minutes % 60);
}

std::string minute_of_clock(std::int64_t clock_us) {
  return date::format("%F %H:%M", date::floor<std::chrono::minutes>(clock_time(clock_us)));
}

}  // namespace

std::string format_time(std::int64_t time_us, const TimeZone& zone) {
  const std::int64_t offset_us = zone.period_at(time_us).offset_us;
  // Before standard times a place had its own, to the second: ISO 8601 cannot say that.
  if (offset_us % kMinute_us != 0) return format_time(time_us);
  const ClockTime time = clock_time(time_us + offset_us);
  const auto seconds = date::floor<std::chrono::seconds>(time);
  return (seconds == time ? date::format("%FT%T", seconds) : date::format("%FT%T", time)) +
         offset_text(zone, offset_us);
}

std::string second_in_zone(std::int64_t time_us, const TimeZone& zone) {
  const auto second = date::floor<std::chrono::seconds>(std::chrono::microseconds(time_us));
  return format_time(std::chrono::microseconds(second).count(), zone);
}

std::string minute_in_zone(std::int64_t time_us, const TimeZone& zone) {
  const TimeZone::Period period = zone.period_at(time_us);
  return minute_of_clock(time_us + period.offset_us) + " " + period.words;
}

std::string minute_below_zone(std::int64_t time_us, const TimeZone& zone) {
  return zone.is_utc() ? minute_of_clock(time_us) : minute_in_zone(time_us, zone);
}

std::string day_in_zone(std::int64_t time_us, const TimeZone& zone) {
  return date::format("%F", date::floor<date::days>(clock_time(zone.clock_us(time_us))));
}

std::string with_times_in_zone(std::string_view sentence, const TimeZone& zone) {
  constexpr std::string_view kZone = " UTC";
  constexpr std::size_t kTime = 16;  // "2026-03-01 12:00"
  std::string text(sentence);
  if (zone.is_utc()) return text;
  for (std::size_t at = text.find(kZone); at != std::string::npos; at = text.find(kZone, at + 1)) {
    if (at < kTime) continue;
    const std::size_t begin = at - kTime;
    const auto time = parse_time(std::string_view(text).substr(begin, kTime));
    if (time) text.replace(begin, kTime + kZone.size(), minute_in_zone(time->clock_us, zone));
  }
  return text;
}

}  // namespace loopscope::daemon
