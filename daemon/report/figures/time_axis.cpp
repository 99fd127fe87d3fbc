#include "daemon/report/figures/time_axis.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <date/date.h>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/signal/microseconds.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using Periods = std::vector<TimeZone::Period>;

constexpr std::int64_t kDay_s = 86'400;
/// Words of a time axis stand side by side on a picture this wide; where they name the clock,
/// fewer do.
constexpr std::int64_t kMostTics = 6;
constexpr std::int64_t kMostLongTics = 4;
/// Half of a word that names the clock, below the end of the axis.
constexpr const char* kRoomForLongTics = "set rmargin at screen 0.9\n";

/// Distances between tics that people count in.
constexpr std::array<std::int64_t, 26> kSteps_s{
    1,           2,           5,           10,           15,          30,         60,
    120,         300,         600,         900,          1800,        3600,       7200,
    10800,       21600,       43200,       kDay_s,       2 * kDay_s,  7 * kDay_s, 14 * kDay_s,
    30 * kDay_s, 60 * kDay_s, 90 * kDay_s, 180 * kDay_s, 365 * kDay_s};

std::int64_t tic_step_s(double span_s, std::int64_t most) {
  for (const std::int64_t step : kSteps_s) {
    if (span_s / static_cast<double>(step) <= static_cast<double>(most)) return step;
  }
  const double years = span_s / static_cast<double>(most * kSteps_s.back());
  return static_cast<std::int64_t>(std::ceil(years)) * kSteps_s.back();
}

/// Where the clock is changed, times of day have its name with them.
std::int64_t tic_step_s(double span_s, bool changes) {
  const std::int64_t step_s = tic_step_s(span_s, kMostTics);
  return changes && step_s < kDay_s ? tic_step_s(span_s, kMostLongTics) : step_s;
}

const char* tic_format(std::int64_t step_s) {
  if (step_s < 60) return "%H:%M:%S";
  if (step_s < kDay_s) return "%H:%M";
  return step_s < 90 * kDay_s ? "%d %b" : "%b %Y";
}

/// What an axis shows.
struct Axis {
  double from_s;
  double to_s;
  Periods periods;      ///< of the clock
  std::int64_t step_s;  ///< between tics, by the clock

  Axis(std::int64_t from_us, std::int64_t to_us, const TimeZone& zone)
      : from_s(seconds_of(from_us)),
        to_s(std::max(seconds_of(to_us), from_s + 1.0)),
        periods(zone.periods(from_us, std::max(from_us, to_us))),
        step_s(tic_step_s(to_s - from_s, changes())) {}

  [[nodiscard]] bool changes() const { return periods.size() > 1; }
  /// Whether tics name the clock: days are the same by both.
  [[nodiscard]] bool names_clock() const { return changes() && step_s < kDay_s; }
};

std::string tic_label(std::int64_t clock_s, const TimeZone::Period& period, const Axis& axis) {
  const date::local_seconds clock{std::chrono::seconds(clock_s)};
  const std::string text = date::format(tic_format(axis.step_s), clock);
  return axis.names_clock() ? text + " " + period.words : text;
}

std::int64_t rounded_up(std::int64_t value, std::int64_t step) {
  const std::int64_t below = value / step * step;
  return below < value ? below + step : below;
}

/// The multiples of the step that the clock shows in one period.
std::string tics_of(const TimeZone::Period& period, const Axis& axis, bool silent) {
  const std::int64_t offset_s = period.offset_us / core::signal::kSecond_us;
  const double from_s = std::max(axis.from_s, seconds_of(period.begin_us));
  const double end_s = std::min(std::nextafter(axis.to_s, HUGE_VAL), seconds_of(period.end_us));
  const auto clock_s = static_cast<std::int64_t>(std::ceil(from_s)) + offset_s;
  std::string text;
  for (std::int64_t tic = rounded_up(clock_s, axis.step_s);
       static_cast<double>(tic - offset_s) < end_s; tic += axis.step_s) {
    fmt::format_to(std::back_inserter(text), ", '{}' {}",
                   silent ? "" : tic_label(tic, period, axis), tic - offset_s);
  }
  return text;
}

std::string range_and_tics(const Axis& axis, bool silent) {
  std::string tics;
  for (const TimeZone::Period& period : axis.periods) tics += tics_of(period, axis, silent);
  // A list must not be empty; one tic of a lone moment may lie outside.
  if (tics.empty()) tics = fmt::format(", '' {:.3f}", axis.from_s);
  return fmt::format("{}set xrange [{:.3f}:{:.3f}]\nset xtics offset 0,0.4 ({})\n",
                     axis.names_clock() ? kRoomForLongTics : "", axis.from_s, axis.to_s,
                     std::string_view(tics).substr(2));
}

/// "CET", "CEST, then CET", of a year "CET and CEST".
std::string zone_words(const Periods& periods) {
  std::vector<std::string> words;
  for (const TimeZone::Period& period : periods)
    if (std::ranges::find(words, period.words) == words.end()) words.push_back(period.words);
  return fmt::format("{}", fmt::join(words, periods.size() == 2 ? ", then " : " and "));
}

std::string time_label(std::int64_t from_us, std::int64_t to_us, const TimeZone& zone,
                       const Periods& periods) {
  const std::string from = day_in_zone(from_us, zone);
  const std::string to = day_in_zone(to_us, zone);
  const std::string words = zone_words(periods);
  if (from == to) return fmt::format("time ({}) on {}", words, from);
  return fmt::format("time ({}), {} to {}", words, from, to);
}

}  // namespace

double seconds_of(std::int64_t time_us) {
  return static_cast<double>(time_us) / core::signal::kMicrosecondsPerSecond;
}

std::string time_axis(std::int64_t from_us, std::int64_t to_us, const TimeZone& zone) {
  const Axis axis(from_us, to_us, zone);
  return range_and_tics(axis, false) + fmt::format("set xlabel '{}' offset 0,0.6\n",
                                                   time_label(from_us, to_us, zone, axis.periods));
}

std::string silent_time_axis(std::int64_t from_us, std::int64_t to_us, const TimeZone& zone) {
  return range_and_tics(Axis(from_us, to_us, zone), true) + "unset xlabel\n";
}

}  // namespace loopscope::daemon
