#pragma once

#include <cstddef>
#include <vector>

namespace loopscope::tests::network {

/// What goes in comes out `delay_s` later; told once a step.
class Pipe {
 public:
  Pipe(double delay_s, double step_s);
  double step(double value);

 private:
  std::vector<double> held_;
  std::size_t at_ = 0;
};

/// First-order lag of gain 1; `time_constant_s` 0 = none.
class Lag {
 public:
  Lag(double time_constant_s, double step_s);
  double step(double target) { return value_ += share_ * (target - value_); }
  [[nodiscard]] double value() const { return value_; }

 private:
  double share_;
  double value_ = 0.0;
};

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
  Pipe pipe_;
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

class ControllerState {
 public:
  ControllerState(const Controller& controller, double op0) : controller_(controller), op_(op0) {}
  double step(double error);
  [[nodiscard]] double op() const { return op_; }

 private:
  Controller controller_;
  double op_;
  double last_ = 0.0;
};

}  // namespace loopscope::tests::network
