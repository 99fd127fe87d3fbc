#include "core/hos/numeric/magnitude.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {

double largest_magnitude(std::span<const double> signal) {
  double largest = 0.0;
  for (const double sample : signal) {
    // A branch that is hardly ever taken: no comparison waits for the one before it.
    if (std::abs(sample) > largest && std::isfinite(sample)) {
      largest = std::abs(sample);
    }
  }
  return largest;
}

double first_finite(std::span<const double> signal) {
  const auto found = std::find_if(signal.begin(), signal.end(),
                                  [](double sample) { return std::isfinite(sample); });
  return found == signal.end() ? 0.0 : *found;
}

FiniteMean finite_mean(std::span<const double> signal) {
  FiniteMean found;
  for (const double sample : signal) {
    if (!std::isfinite(sample)) continue;
    found.mean += sample;
    found.count += 1.0;
  }
  found.mean /= std::max(found.count, 1.0);
  return found;
}

double power_of_two_below(double magnitude) {
  constexpr int kLargestExponent = 1000;
  if (magnitude == 0.0) {
    return 1.0;
  }
  return std::ldexp(1.0, std::clamp(std::ilogb(magnitude), -kLargestExponent, kLargestExponent));
}

std::vector<double> scaled_to_unit(std::span<const double> signal) {
  const double scale = 1.0 / power_of_two_below(largest_magnitude(signal));
  std::vector<double> scaled(signal.size());
  std::transform(signal.begin(), signal.end(), scaled.begin(),
                 [scale](double value) { return value * scale; });
  return scaled;
}

}  // namespace loopscope::core::hos
