#include "core/loop/deviate_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loopscope::core::loop {
namespace {

/// Up to here the exact deviate is at most 0.065 above the approximate one, further up, with few
/// degrees of freedom, as much as 1.
constexpr double kHighest = 2.0;
constexpr double kRoom = 0.1;
/// No exact deviate is less: tails below 1e-300 count as that.
constexpr double kLowest = -37.1;

}  // namespace

double f_deviate_bound(double ratio, double freedom_1, double freedom_2) {
  const double variance_1 = 2.0 / (9.0 * freedom_1), variance_2 = 2.0 / (9.0 * freedom_2);
  const double root = std::cbrt(ratio);
  const double deviate = ((1.0 - variance_2) * root - (1.0 - variance_1)) /
                         std::sqrt(variance_2 * root * root + variance_1);
  return deviate > kHighest ? std::numeric_limits<double>::infinity()
                            : std::max(deviate, kLowest) + kRoom;
}

}  // namespace loopscope::core::loop
