#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace loopscope::tests::generators {

/// What goes in comes out so many steps later, zeros before it; told once a step.
class Delay {
 public:
  explicit Delay(std::size_t steps) : held_(steps, 0.0) {}

  double step(double value) {
    if (held_.empty()) return value;
    std::swap(held_[at_], value);
    at_ = at_ + 1 == held_.size() ? 0 : at_ + 1;
    return value;
  }

 private:
  std::vector<double> held_;
  std::size_t at_ = 0;
};

}  // namespace loopscope::tests::generators
