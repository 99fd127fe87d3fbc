#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace date {
class time_zone;
}  // namespace date

namespace loopscope::daemon {

/// The local clock of a place, by the IANA time zone database of this system; all times are
/// microseconds since 1970, UTC but for those of the clock. A small value that may be shared by
/// threads. The database's rules end with the year 2037: later, no daylight saving.
class TimeZone {
 public:
  /// UTC, which needs no database.
  TimeZone() = default;
  /// One that config::is_time_zone() knows; throws std::runtime_error for any other.
  explicit TimeZone(const std::string& name);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool is_utc() const { return zone_ == nullptr; }

  /// A time in which the clock is not changed.
  struct Period {
    std::int64_t begin_us = 0;
    std::int64_t end_us = 0;     ///< the next change; this moment is not of the period
    std::int64_t offset_us = 0;  ///< how far the clock is ahead of UTC
    std::string words;           ///< "CET"; where it has no abbreviation "UTC+04"
  };
  [[nodiscard]] Period period_at(std::int64_t time_us) const;

  /// The periods that `from_us` to `to_us` (not before it) lie in, in their order; at least one.
  [[nodiscard]] std::vector<Period> periods(std::int64_t from_us, std::int64_t to_us) const;

  /// What the clock shows.
  [[nodiscard]] std::int64_t clock_us(std::int64_t time_us) const {
    return time_us + period_at(time_us).offset_us;
  }

  /// When the clock shows `clock_us`: once, or twice where it was put back, or never where it was
  /// put forward; `change_us` is when it was put back or forward, else 0.
  struct Moments {
    std::vector<std::int64_t> times_us;  ///< ascending
    std::int64_t change_us = 0;
  };
  [[nodiscard]] Moments moments_of(std::int64_t clock_us) const;

 private:
  std::string name_ = "UTC";
  const date::time_zone* zone_ = nullptr;  ///< the library's, which stays; nullptr = UTC
};

}  // namespace loopscope::daemon
