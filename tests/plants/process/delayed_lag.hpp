#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace loopscope::tests::process {

/// gain exp(-dead_time s) / (time_constant s + 1), exact for an input that stands for a step.
class DelayedLag {
 public:
  DelayedLag(double gain, double time_constant_s, double dead_time_s, double step_s)
      : gain_(gain),
        fresh_(1.0 - std::exp(-step_s / time_constant_s)),
        pipe_(static_cast<std::size_t>(std::lround(dead_time_s / step_s)), 0.0) {}

  double step(double input) {
    if (!pipe_.empty()) {
      std::swap(input, pipe_[at_]);
      at_ = at_ + 1 == pipe_.size() ? 0 : at_ + 1;
    }
    return value_ += fresh_ * (gain_ * input - value_);
  }

  [[nodiscard]] double value() const { return value_; }

 private:
  double gain_;
  double fresh_;
  std::vector<double> pipe_;
  std::size_t at_ = 0;
  double value_ = 0.0;
};

}  // namespace loopscope::tests::process
