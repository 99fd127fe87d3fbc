#include "core/simulate/effects/process_change.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace loopscope::core::simulate {

void check(const ProcessNonlinearity& nonlinearity) {
  if (!(std::abs(nonlinearity.curvature) <= 1.0)) {
    throw std::invalid_argument("process_nonlinearity: curvature outside -1 to 1");
  }
}

void check(const GainChange& change) {
  const bool times = change.at_s >= 0.0 && change.rate_per_hour >= 0.0;
  if (!(times && change.ratio >= 0.01 && change.ratio <= 100.0)) {
    throw std::invalid_argument(
        "gain_change: at >= 0, rate >= 0, 0.01 <= ratio <= 100 does not hold");
  }
}

double curved_answer(const ProcessNonlinearity& nonlinearity, double answer) {
  const double c = nonlinearity.curvature;
  if (c == 0.0) {
    return answer;
  }
  const double vertex = -25.0 / c;
  const double reached = c > 0.0 ? std::max(answer, vertex) : std::min(answer, vertex);
  return reached + c * reached * reached / 50.0;
}

double gain_factor(const GainChange& change, double time_s) {
  if (time_s < change.at_s) {
    return 1.0;
  }
  const double whole = change.ratio - 1.0;
  if (change.rate_per_hour == 0.0) {
    return change.ratio;
  }
  const double moved = change.rate_per_hour * (time_s - change.at_s) / 3600.0;
  return 1.0 + std::copysign(std::min(moved, std::abs(whole)), whole);
}

}  // namespace loopscope::core::simulate
