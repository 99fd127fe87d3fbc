#include "daemon/service/windows/slot.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/microseconds.hpp"

namespace loopscope::daemon {
namespace {

constexpr double kFirstPause_s = 60.0;
constexpr double kLongestPause_s = 6.0 * 3600.0;
/// 2^9 minutes are beyond the longest pause; larger exponents would only overflow.
constexpr int kMostAttemptsCounted = 9;

}  // namespace

std::int64_t floor_to_period(std::int64_t time_us, double period_s) {
  const std::int64_t period_us = std::max<std::int64_t>(core::signal::microseconds(period_s), 1);
  const std::int64_t remainder = time_us % period_us;
  return time_us - (remainder < 0 ? remainder + period_us : remainder);
}

std::int64_t slot_to_analyse(std::int64_t newest_us, std::optional<std::int64_t> last_completed_us,
                             double period_s, int catch_up) {
  if (!last_completed_us || *last_completed_us >= newest_us) return newest_us;
  const std::int64_t period_us = std::max<std::int64_t>(core::signal::microseconds(period_s), 1);
  // The last one may lie off the grid: the period may have been another then.
  const std::int64_t next_us = floor_to_period(*last_completed_us, period_s) + period_us;
  return std::clamp(next_us, newest_us - catch_up * period_us, newest_us);
}

std::vector<std::int64_t> earlier_slots(std::int64_t slot_end_us,
                                        std::optional<std::int64_t> last_completed_us,
                                        double period_s, int count) {
  const std::int64_t period_us = std::max<std::int64_t>(core::signal::microseconds(period_s), 1);
  const bool passed = last_completed_us && *last_completed_us < slot_end_us;
  std::int64_t end = passed ? *last_completed_us : slot_end_us - period_us;
  std::vector<std::int64_t> ends;
  for (int k = 0; k < count; ++k, end -= period_us) ends.push_back(end);
  return ends;
}

std::int64_t next_due(std::int64_t slot_end_us, double period_s, double settle_s) {
  return slot_end_us + core::signal::microseconds(period_s) + core::signal::microseconds(settle_s);
}

std::int64_t next_due_by_rows(std::int64_t slot_end_us, std::int64_t now_us, double period_s,
                              double settle_s) {
  const std::int64_t settled_us = now_us - core::signal::microseconds(settle_s);
  return next_due(std::max(slot_end_us, floor_to_period(settled_us, period_s)), period_s, settle_s);
}

double retry_pause_s(int attempts) {
  return std::min(std::ldexp(kFirstPause_s, std::clamp(attempts, 0, kMostAttemptsCounted)),
                  kLongestPause_s);
}

}  // namespace loopscope::daemon
