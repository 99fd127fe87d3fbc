#include "core/simulate/effects/sensor.hpp"

#include <cmath>
#include <stdexcept>

namespace loopscope::core::simulate {

void check(const SensorQuantisation& quantisation) {
  if (!(quantisation.step > 0.0 && std::isfinite(quantisation.step))) {
    throw std::invalid_argument("sensor_quantisation: step > 0 does not hold");
  }
}

void check(const SensorHold& hold) {
  const bool in_range = hold.samples >= 1.0 && hold.samples <= 10000.0;
  if (!in_range || std::trunc(hold.samples) != hold.samples) {
    throw std::invalid_argument("sensor_hold: samples is not a whole number from 1 to 10000");
  }
}

double quantised(const SensorQuantisation& quantisation, double pv) {
  return quantisation.step * std::round(pv / quantisation.step);
}

HoldingSensor::HoldingSensor(const SensorHold& hold) {
  check(hold);
  period_ = std::lround(hold.samples);
}

double HoldingSensor::next(double pv) {
  if (age_ == 0) {
    held_ = pv;
  }
  age_ = (age_ + 1) % period_;
  return held_;
}

}  // namespace loopscope::core::simulate
