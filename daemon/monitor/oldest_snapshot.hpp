#pragma once

#include <chrono>
#include <string>
#include <utility>

namespace loopscope::daemon {

/// For how long the results database has kept the same oldest snapshot for somebody, as far as this
/// process has seen: PostgreSQL tells which one it is, not since when.
class OldestSnapshot {
 public:
  using Clock = std::chrono::steady_clock;

  /// `transaction`: of storage::ScheduleHealth; empty = none is kept. Seconds.
  double seconds_kept(const std::string& transaction, Clock::time_point now) {
    if (std::exchange(transaction_, transaction) != transaction) since_ = now;
    return transaction.empty() ? 0.0 : std::chrono::duration<double>(now - since_).count();
  }

 private:
  std::string transaction_;
  Clock::time_point since_;
};

}  // namespace loopscope::daemon
