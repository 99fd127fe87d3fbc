#include "core/simulate/effects/valve_deadband.hpp"

#include <algorithm>
#include <stdexcept>

namespace loopscope::core::simulate {

ValveWithPlay::ValveWithPlay(const ValveDeadband& deadband)
    : half_width_(0.5 * deadband.width_percent) {
  if (!(half_width_ >= 0.0 && half_width_ <= 50.0)) {
    throw std::invalid_argument("valve_deadband: width outside 0 to 100");
  }
}

double ValveWithPlay::next(double op_percent) {
  if (!started_) {
    started_ = true;
    position_ = op_percent;
  }
  position_ = std::clamp(position_, op_percent - half_width_, op_percent + half_width_);
  return position_;
}

}  // namespace loopscope::core::simulate
