#include "daemon/service/historians/source_gate.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace loopscope::daemon {
namespace {

storage::DatabaseError no_place(const std::string& source, int limit,
                                SourceGate::Duration patience) {
  const std::string in_use =
      limit == 1 ? "the only connection is in use and did not come free"
                 : fmt::format("all {} connections are in use and none came free", limit);
  return {fmt::format("{} within {:.0f} s, historian {}", in_use,
                      std::chrono::duration<double>(patience).count(), source),
          "raise max_connections of this historian, or lower /daemon/workers",
          storage::Remedy::retry};
}

/// Longer than any batch of windows takes to read: whoever has not got a connection by then is
/// better off with other loops.
constexpr double kPatience_s = 30.0;
/// The wait for a connection takes at most this share of what a claim holds: the rest is for the
/// work.
constexpr double kPatienceOfHold = 1.0 / 3.0;
/// Of a source that failed; a poll at most.
constexpr double kSourcePause_s = 30.0;

SourceGate::Duration gate_duration(double seconds) {
  return std::chrono::duration_cast<SourceGate::Duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

/// While a source is down, whoever is inside already is the one that tries.
void SourceGate::throw_if_down() {
  if (fault_ && (inside_ > 0 || Clock::now() < try_again_at_)) throw *fault_;
}

void SourceGate::enter(const std::string& source, int limit, Duration patience) {
  const Clock::time_point deadline = Clock::now() + patience;
  std::unique_lock lock(mutex_);
  throw_if_down();
  while (inside_ >= limit) {
    if (changed_.wait_until(lock, deadline) == std::cv_status::timeout && inside_ >= limit) {
      throw no_place(source, limit, patience);
    }
    throw_if_down();
  }
  ++inside_;
}

void SourceGate::leave() {
  const std::lock_guard lock(mutex_);
  --inside_;
  fault_.reset();
  changed_.notify_all();
}

void SourceGate::leave_down(const storage::DatabaseError& fault, Duration pause) {
  const std::lock_guard lock(mutex_);
  --inside_;
  fault_ = fault;
  try_again_at_ = Clock::now() + pause;
  changed_.notify_all();
}

bool SourceGate::is_down() {
  const std::lock_guard lock(mutex_);
  return fault_.has_value();
}

std::optional<SourceGate::Duration> SourceGate::closed_for() {
  const std::lock_guard lock(mutex_);
  const Duration left = try_again_at_ - Clock::now();
  if (!fault_ || (inside_ == 0 && left <= Duration::zero())) return std::nullopt;
  return std::max(left, Duration::zero());
}

int SourceGate::inside() {
  const std::lock_guard lock(mutex_);
  return inside_;
}

double source_pause_s(const config::ScheduleSettings& schedule) {
  return std::min(kSourcePause_s, schedule.poll_s);
}

SourceTerms source_terms(const config::ScheduleSettings& schedule) {
  return {gate_duration(std::min(kPatience_s, kPatienceOfHold * schedule.hold_s())),
          gate_duration(source_pause_s(schedule)), schedule.hold_s()};
}

}  // namespace loopscope::daemon
