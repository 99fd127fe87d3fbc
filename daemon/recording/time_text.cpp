#include "daemon/recording/time_text.hpp"

#include <chrono>
#include <date/date.h>
#include <sstream>

namespace loopscope::daemon {
namespace {

using Microseconds = date::sys_time<std::chrono::microseconds>;

bool parses(const std::string& text, const char* format, Microseconds& time) {
  std::istringstream stream(text);
  stream >> date::parse(format, time);
  return !stream.fail() && stream.peek() == std::istringstream::traits_type::eof();
}

}  // namespace

std::optional<std::int64_t> parse_time(std::string_view text) {
  const std::string whole(text);
  for (const char* format : {"%FT%TZ", "%FT%T", "%FT%T%Ez", "%F %TZ", "%F %T", "%F %T%Ez",
                             "%FT%T%z", "%F %T%z", "%FT%RZ", "%F %R", "%FT%R", "%F"}) {
    Microseconds time;
    if (parses(whole, format, time)) return time.time_since_epoch().count();
  }
  return std::nullopt;
}

std::string format_time(std::int64_t time_us) {
  const Microseconds time{std::chrono::microseconds(time_us)};
  const auto seconds = date::floor<std::chrono::seconds>(time);
  return seconds == time ? date::format("%FT%TZ", seconds) : date::format("%FT%TZ", time);
}

}  // namespace loopscope::daemon
