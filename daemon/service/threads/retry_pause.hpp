#pragma once

#include <random>

namespace loopscope::daemon {

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

}  // namespace loopscope::daemon
