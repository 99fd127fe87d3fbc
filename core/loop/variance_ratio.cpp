#include "core/loop/variance_ratio.hpp"

#include <cmath>
#include <numbers>

namespace loopscope::core::loop {

double variance_ratio_deviate(double ratio, double freedom_1, double freedom_2) {
  const double a = 2.0 / (9.0 * freedom_1);
  const double b = 2.0 / (9.0 * freedom_2);
  const double root = std::cbrt(ratio);
  return ((1.0 - b) * root - (1.0 - a)) / std::sqrt(b * root * root + a);
}

double upper_normal_tail(double deviate) {
  return 0.5 * std::erfc(deviate / std::numbers::sqrt2);
}

}  // namespace loopscope::core::loop
