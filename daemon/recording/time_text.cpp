#include "daemon/recording/time_text.hpp"

#include <chrono>
#include <date/date.h>
#include <sstream>

#include "storage/timestamp.hpp"

namespace loopscope::daemon {
namespace {

using Microseconds = date::sys_time<std::chrono::microseconds>;

bool parses(const std::string& text, const char* format, Microseconds& time) {
  std::istringstream stream(text);
  stream >> date::parse(format, time);
  return !stream.fail() && stream.peek() == std::istringstream::traits_type::eof();
}

/// The database would clip any other time without a word.
std::optional<std::int64_t> storable(std::int64_t time_us) {
  const bool held = time_us >= storage::kEarliestTimeUs && time_us <= storage::kLatestTimeUs;
  return held ? std::optional(time_us) : std::nullopt;
}

}  // namespace

std::optional<std::int64_t> parse_time(std::string_view text) {
  const std::string whole(text);
  for (const char* format : {"%FT%TZ", "%FT%T", "%FT%T%Ez", "%F %TZ", "%F %T", "%F %T%Ez",
                             "%FT%T%z", "%F %T%z", "%FT%RZ", "%F %R", "%FT%R", "%F"}) {
    Microseconds time;
    if (parses(whole, format, time)) return storable(time.time_since_epoch().count());
  }
  return std::nullopt;
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
