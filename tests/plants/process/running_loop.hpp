#pragma once

#include <optional>
#include <vector>

#include "tests/plants/process/signals.hpp"
#include "tests/plants/process/simulate.hpp"

namespace loopscope::tests::process {

/// Sensor, PI controller and record of one loop, one step at a time.
class RunningLoop {
 public:
  /// `first` = the step of the first sample.
  RunningLoop(const LoopPlan& plan, double step_s, std::uint64_t seed, Window window, long first);

  /// `told` = setpoint from another loop.
  void scan(long step, double value, std::optional<double> told);
  void record(long step);

  [[nodiscard]] double op() const { return op_; }
  [[nodiscard]] double op_as_setpoint(const LoopPlan& slave) const;
  [[nodiscard]] double ratio_base() const { return smoothed_; }
  [[nodiscard]] bool out_of_span() const { return out_of_span_; }
  [[nodiscard]] Record take() { return std::move(record_); }

 private:
  double sense(double value);
  void move_setpoint();
  void control();

  const LoopPlan& plan_;
  double step_s_, scan_s_;
  Random noise_, moves_;
  Sawtooth sawtooth_;
  Window window_;
  long first_;
  double lag_fresh_;
  std::vector<double> pipe_;  ///< of the dead time
  std::size_t pipe_at_ = 0;
  double lagged_, pv_, sp_, op_, integral_, smoothed_;
  bool out_of_span_ = false;
  Record record_;
};

}  // namespace loopscope::tests::process
