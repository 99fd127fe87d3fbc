#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// Drives the units of work of one worker: claim, read, prepare, analyse, write. A unit holds no
/// clock of its own; what it takes is counted here, and that it ended is shown. A unit may run
/// others: their time is not counted twice. For one thread at a time.
class StageDriver {
 public:
  /// A member of StageCost that is a time in seconds.
  using Stage = double storage::StageCost::*;

  /// `step` is called whenever a unit has ended, so that others see that the worker gets on.
  explicit StageDriver(std::function<void()> step = [] {}) : step_(std::move(step)) {}

  /// Runs `work`, counts its time for `stage` and returns what it returned. What it throws passes.
  template <typename Work>
  auto run(Stage stage, Work&& work) {
    const Unit unit(*this, stage);
    return std::forward<Work>(work)();
  }

  /// Inside a unit: the time since it began, or since the last call, is that of `stage` and not
  /// the unit's own. Returns it in ms.
  double split(Stage stage);
  /// What the last unit that ended took, those inside it included, in ms.
  [[nodiscard]] double last_ms() const { return last_ms_; }

  /// What was counted since take(); units may add their numbers.
  [[nodiscard]] storage::StageCost& cost() { return cost_; }
  /// Hands it over and starts anew.
  [[nodiscard]] storage::StageCost take() { return std::exchange(cost_, {}); }

 private:
  using Clock = std::chrono::steady_clock;
  class Unit {
   public:
    Unit(StageDriver& driver, Stage stage);
    ~Unit();
    Unit(const Unit&) = delete;
    Unit& operator=(const Unit&) = delete;

   private:
    StageDriver& driver_;
    Stage outer_;
    Clock::time_point begun_;
  };

  std::function<void()> step_;
  storage::StageCost cost_;
  Stage stage_ = nullptr;  ///< of the innermost unit that runs
  Clock::time_point since_;
  double last_ms_ = 0.0;
};

}  // namespace loopscope::daemon
