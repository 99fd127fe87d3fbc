#pragma once

#include <cmath>

#include "tests/effects/load_model.hpp"

namespace loopscope::tests::effects {

/// A first-order lag that is told its target once a substep; `time_constant` in samples, > 0.
class Lag {
 public:
  Lag(double time_constant, double start)
      : share_(1.0 - std::exp(-1.0 / (kSubsteps * time_constant))), value_(start) {}
  double step(double target) { return value_ += share_ * (target - value_); }
  [[nodiscard]] double value() const { return value_; }

 private:
  double share_;
  double value_;
};

}  // namespace loopscope::tests::effects
