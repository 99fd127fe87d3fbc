#include "tests/effects/valve.hpp"

#include <algorithm>
#include <cmath>

#include "tests/effects/actuator_lag.hpp"

namespace loopscope::tests::effects {
namespace {

class BacklashValve final : public Valve {
 public:
  BacklashValve(double width, Actuator actuator, double response)
      : half_(width / 2.0), stem_(lag_of(actuator)), plug_(lag_of({response, actuator.start})) {}

  double step(double op) override {
    const double stem = stem_.step(op);
    return plug_.step(std::clamp(plug_.value(), stem - half_, stem + half_));
  }

 private:
  double half_;
  Lag stem_;
  Lag plug_;
};

class StopValve final : public Valve {
 public:
  StopValve(double low, double high, Actuator actuator)
      : low_(low), high_(high), stem_(lag_of(actuator)) {}

  double step(double op) override {
    const double position = stem_.step(op);
    return low_ + squeeze(high_ - low_ - squeeze(high_ - position));
  }

 private:
  static constexpr double kSoftness = 0.25;  ///< %: 98 % of the bend lies within 1 % of the stop

  /// Smooth max(0, distance).
  static double squeeze(double distance) {
    return distance > 40.0 * kSoftness ? distance
                                       : kSoftness * std::log1p(std::exp(distance / kSoftness));
  }

  double low_;
  double high_;
  Lag stem_;
};

class HuntingValve final : public Valve {
 public:
  HuntingValve(double amplitude, double period, Actuator actuator)
      : amplitude_(amplitude),
        speed_(4.0 * amplitude / period),
        target_(lag_of(actuator)),
        stem_(actuator.start) {}

  double step(double op) override {
    const double last = target_.value();
    const double target = target_.step(op);
    stem_ += kFollows * (target - last) + direction_ * speed_ * kStep;
    if (stem_ > target + amplitude_) direction_ = -1.0;
    if (stem_ < target - amplitude_) direction_ = 1.0;
    return stem_;
  }

 private:
  static constexpr double kFollows = 0.8;  ///< of a move of op at once; hunting makes up the rest

  double amplitude_;
  double speed_;
  Lag target_;
  double stem_;
  double direction_ = 1.0;
};

}  // namespace

std::unique_ptr<Valve> make_backlash_valve(double width, Actuator actuator, double response) {
  return std::make_unique<BacklashValve>(width, actuator, response);
}

std::unique_ptr<Valve> make_stop_valve(double low, double high, Actuator actuator) {
  return std::make_unique<StopValve>(low, high, actuator);
}

std::unique_ptr<Valve> make_hunting_valve(double amplitude, double period, Actuator actuator) {
  return std::make_unique<HuntingValve>(amplitude, period, actuator);
}

}  // namespace loopscope::tests::effects
