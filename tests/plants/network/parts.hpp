#pragma once

#include "tests/generators/delay.hpp"
#include "tests/generators/lag.hpp"

namespace loopscope::tests::network {

using generators::Delay;
using generators::Lag;

/// Whole steps of a time.
[[nodiscard]] Delay delay_of(double time_s, double step_s);
[[nodiscard]] Lag lag_of(double time_constant_s, double step_s);  ///< 0 = none

/// What lies between the flow through a valve and the sensor, in % of span and seconds.
struct Process {
  bool integrating = false;
  double gain = 1.0;  ///< pv by flow; integrating: pv per second and flow
  double time_constant_s = 10.0;
  double second_time_constant_s = 0.0;  ///< 0 = none
  double delay_s = 1.0;
};

class ProcessState {
 public:
  ProcessState(const Process& process, double step_s);
  /// `flow` is delayed, `load` joins behind the delay.
  double step(double flow, double load);
  [[nodiscard]] double pv() const { return second_.value(); }

 private:
  Process process_;
  double step_s_;
  Delay pipe_;
  Lag first_;
  Lag second_;
  double level_ = 0.0;
};

/// PI with op held to 0 to 100 % and the integral stopped there.
struct Controller {
  double gain = 1.0;  ///< % by %
  double integral_time_s = 10.0;
  double scan_s = 1.0;
};

}  // namespace loopscope::tests::network
