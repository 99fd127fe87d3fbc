#include "core/hos/bicoherence/moments.hpp"

#include <cmath>
#include <limits>

#include "core/hos/numeric/magnitude.hpp"

namespace loopscope::core::hos {

Moments moments(std::span<const double> signal, const Kernels& kernels) {
  const double largest = kernels.scan(signal).largest;
  if (largest == 0.0) {
    return {};
  }
  const double scale = power_of_two_below(largest);
  // About the first sample: the sum of what is left of a constant is exactly zero, where that of
  // the samples themselves would gather rounding.
  Centring centring{1.0 / scale, first_finite(signal) / scale, 0.0};
  const PowerSums raw = kernels.sum_powers(signal, centring);
  centring.centre = raw.first / raw.count;
  const PowerSums central = kernels.sum_powers(signal, centring);
  const double m2 = central.second;
  const double noise = kRoundingUnits * std::numeric_limits<double>::epsilon() * largest / scale;
  if (m2 <= noise * noise * central.count) {
    return {};
  }
  return {central.third / central.count / std::pow(m2 / central.count, 1.5),
          central.fourth * central.count / (m2 * m2) - 3.0};
}

}  // namespace loopscope::core::hos
