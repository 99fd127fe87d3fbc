#pragma once

#include <algorithm>

namespace loopscope::tests::generators {

/// Limits of op, %.
struct OpLimits {
  double low = 0.0;
  double high = 100.0;
};

/// op(k) = op(k-1) + gain (e(k) - e(k-1) + e(k) scan / integral_time), held to its limits: the
/// integral stops there.
class PiController {
 public:
  explicit PiController(double op, OpLimits limits = {}) : op_(op), limits_(limits) {}

  double step(double error, double gain, double integral_time, double scan = 1.0) {
    const double move = error - last_error_ + error * scan / integral_time;
    last_error_ = error;
    return op_ = std::clamp(op_ + gain * move, limits_.low, limits_.high);
  }
  [[nodiscard]] double op() const { return op_; }

 private:
  double op_;
  OpLimits limits_;
  double last_error_ = 0.0;
};

}  // namespace loopscope::tests::generators
