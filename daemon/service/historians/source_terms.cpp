#include "daemon/service/historians/source_terms.hpp"

#include <algorithm>
#include <chrono>

namespace loopscope::daemon {
namespace {

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

double source_pause_s(const config::ScheduleSettings& schedule) {
  return std::min(kSourcePause_s, schedule.poll_s);
}

SourceTerms source_terms(const config::ScheduleSettings& schedule) {
  return {gate_duration(std::min(kPatience_s, kPatienceOfHold * schedule.hold_s())),
          gate_duration(source_pause_s(schedule)), schedule.hold_s()};
}

}  // namespace loopscope::daemon
