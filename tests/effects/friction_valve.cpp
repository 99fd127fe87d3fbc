#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/effects/actuator_lag.hpp"
#include "tests/effects/valve.hpp"

namespace loopscope::tests::effects {
namespace {

using generators::slipped;

class HeValve final : public Valve {
 public:
  HeValve(Friction friction, Actuator actuator)
      : friction_(friction), pressure_(lag_of(actuator)), stem_(actuator.start) {}

  double step(double op) override { return stem_ = slipped(stem_, pressure_.step(op), friction_); }

 private:
  Friction friction_;
  Lag pressure_;
  double stem_;
};

class KarnoppValve final : public Valve {
 public:
  KarnoppValve(Friction friction, Actuator actuator, double response)
      : friction_(friction),
        pressure_(lag_of(actuator)),
        stem_(actuator.start),
        viscous_(response),
        mass_(response * response / kOverdamped) {}

  double step(double op) override {
    pressure_.step(op);
    for (int i = 0; i < kInner; ++i) move();
    return stem_;
  }

 private:
  /// Mass below the critical one: a packed stem does not swing.
  static constexpr double kOverdamped = 10.0;
  static constexpr int kInner = 10;
  static constexpr double kInnerStep = kStep / kInner;
  static constexpr double kDeadZone = 1e-4;  ///< % per sample: far below any speed of a slip

  void move() {
    const double force = pressure_.value() - stem_;
    if (std::abs(speed_) < kDeadZone) {
      speed_ = 0.0;
      if (std::abs(force) <= friction_.static_friction) return;
    }
    const double direction = speed_ != 0.0 ? speed_ : force;
    const double net = force - std::copysign(friction_.kinetic_friction, direction);
    const double next = implicit_speed(net);
    speed_ = next * direction < 0.0 ? 0.0 : next;  // friction stops, it does not push
    stem_ += kInnerStep * speed_;
  }

  [[nodiscard]] double implicit_speed(double net) const {
    const double h = kInnerStep;
    return (speed_ + h / mass_ * net) / (1.0 + h * viscous_ / mass_ + h * h / mass_);
  }

  Friction friction_;
  Lag pressure_;
  double stem_;
  double viscous_;
  double mass_;
  double speed_ = 0.0;
};

class IntermittentValve final : public Valve {
 public:
  IntermittentValve(Friction friction, Actuator actuator, std::vector<double> switches)
      : friction_(friction),
        pressure_(lag_of(actuator)),
        stem_(actuator.start),
        switches_(std::move(switches)) {}

  double step(double op) override {
    time_ += kStep;
    while (passed_ < switches_.size() && switches_[passed_] <= time_) ++passed_;
    const double pressure = pressure_.step(op);
    const bool sticks = passed_ % 2 == 1;
    return stem_ = sticks ? slipped(stem_, pressure, friction_) : pressure;
  }

 private:
  Friction friction_;
  Lag pressure_;
  double stem_;
  std::vector<double> switches_;
  std::size_t passed_ = 0;
  double time_ = 0.0;
};

}  // namespace

std::unique_ptr<Valve> make_he_valve(Friction friction, Actuator actuator) {
  return std::make_unique<HeValve>(friction, actuator);
}

std::unique_ptr<Valve> make_karnopp_valve(Friction friction, Actuator actuator, double response) {
  return std::make_unique<KarnoppValve>(friction, actuator, response);
}

std::unique_ptr<Valve> make_sticking_valve(bool karnopp, Friction friction, Actuator actuator,
                                           double response) {
  return karnopp ? make_karnopp_valve(friction, actuator, response)
                 : make_he_valve(friction, actuator);
}

std::unique_ptr<Valve> make_intermittent_valve(Friction friction, Actuator actuator,
                                               std::vector<double> switches) {
  return std::make_unique<IntermittentValve>(friction, actuator, std::move(switches));
}

}  // namespace loopscope::tests::effects
