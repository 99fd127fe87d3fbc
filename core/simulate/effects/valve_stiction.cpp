#include "core/simulate/effects/valve_stiction.hpp"

#include <cmath>
#include <stdexcept>

namespace loopscope::core::simulate {

std::string_view name(StictionLaw law) {
  return law == StictionLaw::choudhury ? "choudhury" : "kano";
}

StickingValve::StickingValve(const ValveStiction& stiction) : stiction_(stiction) {
  const double band = stiction.stickband_percent;
  const double jump = stiction.slip_jump_percent;
  if (!(jump >= 0.0 && jump <= band && band <= 100.0)) {
    throw std::invalid_argument("valve_stiction: 0 <= J <= S <= 100 does not hold");
  }
}

void StickingValve::start(double op_percent) {
  started_ = true;
  previous_op_ = op_percent;
  stop_op_ = op_percent;
  position_ = op_percent;
}

void StickingValve::judge_motion(double op_percent) {
  const double slope = op_percent - previous_op_;
  const bool still = slope == 0.0;
  const bool turned = slope * op_direction_ < 0.0;
  const bool stopped = turned || (still && op_stood_still_);
  const bool new_base = !stuck_ || (turned && stiction_.law == StictionLaw::choudhury);
  if (stopped && new_base) {
    stuck_ = true;
    stop_op_ = previous_op_;
  }
  op_stood_still_ = still;
  if (!still) {
    op_direction_ = slope > 0.0 ? 1.0 : -1.0;
  }
}

bool StickingValve::breaks_loose_choudhury(double op_percent) const {
  return std::abs(op_percent - stop_op_) > stiction_.stickband_percent;
}

bool StickingValve::breaks_loose_kano(double op_percent) const {
  const double ahead = direction_ * (op_percent - stop_op_);
  return ahead > stiction_.slip_jump_percent || -ahead > stiction_.stickband_percent;
}

double StickingValve::next(double op_percent) {
  if (!started_) {
    start(op_percent);
    return position_;
  }
  judge_motion(op_percent);
  if (stuck_) {
    const bool loose = stiction_.law == StictionLaw::choudhury ? breaks_loose_choudhury(op_percent)
                                                               : breaks_loose_kano(op_percent);
    if (loose) {
      stuck_ = false;
      direction_ = op_percent > stop_op_ ? 1.0 : -1.0;
    }
  }
  if (!stuck_) {
    position_ =
        op_percent - direction_ * 0.5 * (stiction_.stickband_percent - stiction_.slip_jump_percent);
  }
  previous_op_ = op_percent;
  return position_;
}

}  // namespace loopscope::core::simulate
