#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "storage/stage_cost.hpp"

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

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Where the time of one worker went: the sum, and the part that is not stored yet. Not
/// thread-safe.
class StageTimings {
 public:
  void add(const storage::StageCost& cost);
  [[nodiscard]] const storage::StageCost& sum() const { return sum_; }
  /// What is to be stored now, which then counts as stored: nothing before a minute has passed
  /// since the last time, unless `at_once`; nothing where no loop was done.
  [[nodiscard]] std::optional<storage::StageCost> take(bool at_once);
  /// What was taken could not be stored: it will be given out again.
  void put_back(const storage::StageCost& cost) { storage::add(untaken_, cost); }

 private:
  using Clock = std::chrono::steady_clock;
  storage::StageCost sum_;
  storage::StageCost untaken_;
  Clock::time_point taken_at_ = Clock::now();
};

/// "ms a loop: claim 0.1, fetch 2.3, prepare 0.2, statistics 0.5, model 3.1 (17.4 each of 356),
/// decide 0.2, write 0.9, waiting 1.2"; empty when no loop was done.
[[nodiscard]] std::string cost_text(const storage::StageCost& cost);

}  // namespace loopscope::daemon
