#include "core/simulate/effects/disturbance.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace loopscope::core::simulate {

void check(const ExternalOscillation& oscillation) {
  if (!(oscillation.period_s > 0.0 && oscillation.amplitude >= 0.0)) {
    throw std::invalid_argument("external_oscillation: period_s > 0, amplitude >= 0 does not hold");
  }
}

void check(const LoadStep& step) {
  if (!(step.at_s >= 0.0 && std::isfinite(step.size))) {
    throw std::invalid_argument("load_step: at >= 0 and a finite size do not hold");
  }
}

double disturbance_at(const ExternalOscillation& oscillation, double time_s) {
  return oscillation.amplitude * std::sin(2.0 * std::numbers::pi * time_s / oscillation.period_s);
}

double disturbance_at(const LoadStep& step, double time_s) {
  return time_s < step.at_s ? 0.0 : step.size;
}

}  // namespace loopscope::core::simulate
