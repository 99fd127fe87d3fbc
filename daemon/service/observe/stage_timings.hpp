#pragma once

#include <chrono>
#include <optional>

#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// Where the time of one lane went: the sum, and the part that is not stored yet.
class StageTimings {
 public:
  void add(const storage::StageCost& cost);
  [[nodiscard]] const storage::StageCost& sum() const { return sum_; }
  /// What is to be stored now, taken out of the book: nothing before a minute has passed since the
  /// last time, unless `at_once`; nothing where no loop was done.
  [[nodiscard]] std::optional<storage::StageCost> take(bool at_once);
  /// What was taken could not be stored: it will be given out again.
  void put_back(const storage::StageCost& cost) { storage::add(untaken_, cost); }

 private:
  using Clock = std::chrono::steady_clock;
  storage::StageCost sum_;
  storage::StageCost untaken_;
  Clock::time_point taken_at_ = Clock::now();
};

}  // namespace loopscope::daemon
