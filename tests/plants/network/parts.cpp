#include "tests/plants/network/parts.hpp"

#include <cmath>

namespace loopscope::tests::network {

Delay delay_of(double time_s, double step_s) {
  return Delay(static_cast<std::size_t>(std::lround(time_s / step_s)));
}

Lag lag_of(double time_constant_s, double step_s) {
  return Lag(generators::lag_share(time_constant_s, step_s));
}

ProcessState::ProcessState(const Process& process, double step_s)
    : process_(process),
      step_s_(step_s),
      pipe_(delay_of(process.delay_s, step_s)),
      first_(lag_of(process.time_constant_s, step_s)),
      second_(lag_of(process.second_time_constant_s, step_s)) {}

double ProcessState::step(double flow, double load) {
  const double driven = process_.gain * (pipe_.step(flow) + load);
  level_ += step_s_ * driven;
  return second_.step(process_.integrating ? level_ : first_.step(driven));
}

}  // namespace loopscope::tests::network
