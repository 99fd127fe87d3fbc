#pragma once
/// Parts of simulated loops that every generator of the tests uses (tests/generators/README.md).
/// They share no code with core/.

#include <cmath>

namespace loopscope::tests::generators {

/// Share of the way to its target that a first-order lag goes in a step; a time constant of 0 =
/// none.
[[nodiscard]] inline double lag_share(double time_constant, double step) {
  return time_constant > 0.0 ? 1.0 - std::exp(-step / time_constant) : 1.0;
}

/// First-order lag of gain 1 that is told its target once a step.
class Lag {
 public:
  explicit Lag(double share, double start = 0.0) : share_(share), value_(start) {}
  double step(double target) { return value_ += share_ * (target - value_); }
  [[nodiscard]] double value() const { return value_; }

 private:
  double share_;
  double value_;
};

}  // namespace loopscope::tests::generators
