#pragma once

#include <chrono>

namespace loopscope::daemon {

/// Time since it was made or since the last lap.
class Stopwatch {
 public:
  [[nodiscard]] double lap_s() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }
  [[nodiscard]] double lap_ms() { return 1e3 * lap_s(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace loopscope::daemon
