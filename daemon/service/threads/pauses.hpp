#pragma once

#include <chrono>
#include <optional>
#include <random>
#include <stop_token>

namespace loopscope::daemon {

/// Sleeps for so long; false when a stop was requested before or is meanwhile, which ends the sleep
/// at once.
[[nodiscard]] bool sleep_for(const std::stop_token& stop, std::chrono::duration<double> pause);

/// Pauses between tries at something that is away: from a quarter of a second, doubling, up to
/// `longest_s`. Each is drawn between half of that and the whole, so that the workers of a plant do
/// not come back in step. One object for one series of tries; not thread-safe.
class RetryPause {
 public:
  explicit RetryPause(double longest_s) : longest_s_(longest_s) {}

  /// Seconds, at most `longest_s`.
  [[nodiscard]] double next_s();
  /// It worked: the next series begins anew.
  void reset() { tries_ = 0; }

 private:
  double longest_s_;
  int tries_ = 0;
  std::minstd_rand random_{std::random_device{}()};
};

/// How a worker's look for work has ended.
struct Look {
  bool failed = false;  ///< the results database did
  bool worked = false;  ///< at least one batch was brought to its end
  /// Until a loop falls due or a claim ends; 0 = one is due that could not be claimed.
  double next_due_in_s = 0.0;
};

/// Seconds until the worker looks again: when the next loop falls due, but after a poll at the
/// latest, since other loops may be added; a little later at random, so that not all workers of a
/// plant come at once. Where something is due that cannot be claimed (others have it in hand, a
/// lock is held, its source is away) and after a fault `pause` grows from look to look, up to a
/// poll and to when a source that is away may be tried again.
[[nodiscard]] double idle_pause_s(const Look& look, double poll_s,
                                  std::optional<double> source_opens_in_s, RetryPause& pause);

}  // namespace loopscope::daemon
