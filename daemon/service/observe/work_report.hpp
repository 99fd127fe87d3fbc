#pragma once

#include <chrono>
#include <string>

#include "storage/results/results_database.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// `sum` grown by `more`.
void add(storage::WriteCount& sum, const storage::WriteCount& more);

/// "24 loops: 20 new, 1 revised, 3 unchanged, 0 failed"
[[nodiscard]] std::string count_text(const storage::WriteCount& count);

/// Tells the log what a worker did and where its time went: once at the end of its work, and once a
/// minute while it lasts, so that neither a large plant floods the log nor a long pass is silent.
class WorkReport {
 public:
  /// `cost` is the worker's so far: what it did before is not told again.
  explicit WorkReport(const storage::StageCost& cost) : told_(cost), cost_(cost) {}
  /// A batch is done; `cost` is the worker's sum since.
  void add(const storage::WriteCount& count, const storage::StageCost& cost);
  /// Tells what was not told yet, if there is any.
  void say();

 private:
  using Clock = std::chrono::steady_clock;
  storage::WriteCount count_;
  storage::StageCost told_;
  storage::StageCost cost_;
  Clock::time_point said_at_ = Clock::now();
};

}  // namespace loopscope::daemon
