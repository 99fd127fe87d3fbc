#include "tests/plants/network/parts.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::tests::network {

Pipe::Pipe(double delay_s, double step_s)
    : held_(static_cast<std::size_t>(std::lround(delay_s / step_s)), 0.0) {}

double Pipe::step(double value) {
  if (held_.empty()) return value;
  std::swap(held_[at_], value);
  at_ = at_ + 1 == held_.size() ? 0 : at_ + 1;
  return value;
}

Lag::Lag(double time_constant_s, double step_s)
    : share_(time_constant_s > 0.0 ? 1.0 - std::exp(-step_s / time_constant_s) : 1.0) {}

ProcessState::ProcessState(const Process& process, double step_s)
    : process_(process),
      step_s_(step_s),
      pipe_(process.delay_s, step_s),
      first_(process.time_constant_s, step_s),
      second_(process.second_time_constant_s, step_s) {}

double ProcessState::step(double flow, double load) {
  const double driven = process_.gain * (pipe_.step(flow) + load);
  level_ += step_s_ * driven;
  return second_.step(process_.integrating ? level_ : first_.step(driven));
}

double ControllerState::step(double error) {
  const double move = error - last_ + error * controller_.scan_s / controller_.integral_time_s;
  last_ = error;
  return op_ = std::clamp(op_ + controller_.gain * move, 0.0, 100.0);
}

}  // namespace loopscope::tests::network
