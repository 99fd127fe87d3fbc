#include "core/simulate/pi_controller.hpp"

#include <algorithm>

namespace loopscope::core::simulate {

double PiController::next(double error) {
  const double move = settings_.gain * (error - previous_error_) + settings_.integral * error;
  previous_error_ = error;
  op_percent_ = std::clamp(op_percent_ + move, 0.0, 100.0);
  return op_percent_;
}

}  // namespace loopscope::core::simulate
