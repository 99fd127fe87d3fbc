#include "core/hos/coupling/combine_p.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace loopscope::core::hos {
namespace {

constexpr double kLargest = 0.9;
/// Below this, and above its reciprocal, tan and atan lose their digits and the first term of their
/// series has them all.
constexpr double kSmall = 1e-8;

double cauchy_deviate(double p) {
  const double held = std::clamp(p, std::numeric_limits<double>::min(), kLargest);
  return held < kSmall ? 1.0 / (std::numbers::pi * held)
                       : std::tan(std::numbers::pi * (0.5 - held));
}

}  // namespace

double combine_p(std::span<const double> p) {
  double sum = 0.0;
  for (const double value : p) sum += cauchy_deviate(value) / static_cast<double>(p.size());
  return sum > 1.0 / kSmall ? 1.0 / (std::numbers::pi * sum)
                            : 0.5 - std::atan(sum) / std::numbers::pi;
}

}  // namespace loopscope::core::hos
