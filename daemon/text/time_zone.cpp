#include "daemon/text/time_zone.hpp"

#include <chrono>
#include <date/tz.h>

#include "config/time_zones.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::daemon {
namespace {

using std::chrono::microseconds;

std::int64_t in_us(date::sys_seconds time) {
  return microseconds(time.time_since_epoch()).count();
}

/// Some zones have no letters for their time, but "+04".
std::string zone_words(const std::string& abbreviation) {
  const bool figures = abbreviation.starts_with('+') || abbreviation.starts_with('-');
  return figures ? "UTC" + abbreviation : abbreviation;
}

template <typename Clock>
auto whole_seconds(std::int64_t time_us) {
  return date::floor<std::chrono::seconds>(
      std::chrono::time_point<Clock, microseconds>(microseconds(time_us)));
}

}  // namespace

TimeZone::TimeZone(const std::string& name)
    : name_(name), zone_(name == config::kUtc ? nullptr : date::locate_zone(name)) {}

TimeZone::Period TimeZone::period_at(std::int64_t time_us) const {
  if (is_utc()) return {storage::kEarliestTimeUs, storage::kLatestTimeUs + 1, 0, name_};
  const date::sys_info info = zone_->get_info(whole_seconds<std::chrono::system_clock>(time_us));
  return {in_us(info.begin), in_us(info.end), microseconds(info.offset).count(),
          zone_words(info.abbrev)};
}

std::vector<TimeZone::Period> TimeZone::periods(std::int64_t from_us, std::int64_t to_us) const {
  std::vector<Period> all = {period_at(from_us)};
  while (all.back().end_us <= to_us) all.push_back(period_at(all.back().end_us));
  return all;
}

TimeZone::Moments TimeZone::moments_of(std::int64_t clock_us) const {
  if (is_utc()) return {{clock_us}, 0};
  const date::local_info info = zone_->get_info(whole_seconds<date::local_t>(clock_us));
  const auto before = [&] { return clock_us - microseconds(info.first.offset).count(); };
  const auto behind = [&] { return clock_us - microseconds(info.second.offset).count(); };
  switch (info.result) {
    case date::local_info::nonexistent:
      return {{}, in_us(info.first.end)};
    case date::local_info::ambiguous:
      return {{before(), behind()}, in_us(info.first.end)};
    default:
      return {{before()}, 0};
  }
}

}  // namespace loopscope::daemon
