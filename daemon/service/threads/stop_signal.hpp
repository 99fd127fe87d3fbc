#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace loopscope::daemon {

/// Ends every pause of the process at once when it shall stop. Thread-safe.
class StopSignal {
 public:
  void ring() {
    const std::lock_guard lock(mutex_);
    rung_ = true;
    changed_.notify_all();
  }

  [[nodiscard]] bool rung() {
    const std::lock_guard lock(mutex_);
    return rung_;
  }

  /// Sleeps for so long; false when the bell rang before or meanwhile.
  bool sleep_for(std::chrono::duration<double> pause) {
    using Clock = std::chrono::steady_clock;
    const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
    std::unique_lock lock(mutex_);
    return !changed_.wait_until(lock, until, [this] { return rung_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool rung_ = false;
};

}  // namespace loopscope::daemon
