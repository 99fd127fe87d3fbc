#include "tests/core/loop/harris_null.hpp"

#include <cmath>
#include <utility>

#include "core/loop/harris.hpp"
#include "core/loop/harris_p.hpp"

namespace loopscope::core::loop::signals {
namespace {

double middle_of(const Series& error) {
  const HarrisRange range = measure_harris(error, kMinDelay, kMaxDelay, kOrder).value();
  return std::sqrt(range.low * range.high);
}

}  // namespace

double p_of(const Series& error) {
  return measure_harris(error, kMinDelay, kMaxDelay, kOrder).value().p;
}

Series mixture(Random& random, std::size_t samples, double phi, double share) {
  const double unit = std::sqrt(1.0 - phi * phi);
  const Series slow = ar1(random, samples, phi);
  Series fast = white(random, samples);
  for (double& value : fast) value *= std::sqrt(1.0 - share);
  return sum(std::move(fast), slow, unit * std::sqrt(share));
}

double share_at_null(double phi) {
  double low = 0.001, high = 0.999;
  for (int step = 0; step < 14; ++step) {
    Random random(99);
    const double middle = 0.5 * (low + high);
    (middle_of(mixture(random, 400'000, phi, middle)) > kWellTunedHarris ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace loopscope::core::loop::signals
