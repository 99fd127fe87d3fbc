#include "tests/plants/process/valve.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::tests::process {
namespace {

constexpr double kStemLag_s = 0.8;       // viscous: of a stem that slides freely
constexpr double kStribeck_per_s = 1.0;  // % a second: speed at which the stiction has gone
constexpr double kStuckBelow_per_s = 0.05;

double way_in_step(double lag_s, double step_s) {
  return lag_s > 0.0 ? 1.0 - std::exp(-step_s / lag_s) : 1.0;
}

}  // namespace

Valve::Valve(const ValvePlan& plan, double step_s, double position)
    : plan_(plan),
      fresh_(way_in_step(plan.actuator_lag_s, step_s)),
      slide_fresh_(way_in_step(kStemLag_s, step_s)),
      actuator_(position),
      before_(position),
      stem_(position) {}

double Valve::step(double op) {
  actuator_ += fresh_ * (op - actuator_);
  if (plan_.friction == Friction::play) follow_with_play();
  if (plan_.friction == Friction::jump) jump();
  if (plan_.friction == Friction::stribeck) slide();
  before_ = actuator_;
  return stem_ = std::clamp(stem_, 0.0, 100.0);
}

void Valve::follow_with_play() {
  stem_ = std::clamp(stem_, actuator_ - plan_.play / 2.0, actuator_ + plan_.play / 2.0);
}

void Valve::jump() {
  held_ += actuator_ - before_;
  if (std::abs(held_) <= plan_.stick) return;
  held_ = std::copysign(plan_.slide, held_);
  stem_ = actuator_ - held_;
}

/// The stem is light: its speed is the force over friction by the viscosity.
void Valve::slide() {
  const double force = actuator_ - stem_;
  if (!moving_ && std::abs(force) <= plan_.stick) return;
  const double freely = std::max(0.0, std::abs(force) - plan_.slide) / kStemLag_s;
  const double fall = std::exp(-(freely / kStribeck_per_s) * (freely / kStribeck_per_s));
  const double friction =
      moving_ ? plan_.slide + 0.3 * (plan_.stick - plan_.slide) * fall : plan_.slide;
  const double over = std::abs(force) - friction;
  moving_ = over > kStuckBelow_per_s * kStemLag_s;
  if (over > 0.0) stem_ += std::copysign(slide_fresh_ * over, force);
}

}  // namespace loopscope::tests::process
