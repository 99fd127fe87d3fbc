#include "core/hos/moments.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/hos/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

/// The finite samples, divided by `scale` and about the first of them: the sum of what is left of
/// a constant is exactly zero, where that of the samples themselves would gather rounding.
std::vector<double> scaled(std::span<const double> signal, double scale) {
  std::vector<double> samples;
  samples.reserve(signal.size());
  double first = 0.0;
  for (const double sample : signal) {
    if (std::isfinite(sample)) {
      first = samples.empty() ? sample / scale : first;
      samples.push_back(sample / scale - first);
    }
  }
  return samples;
}

double mean(const std::vector<double>& samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

}  // namespace

Moments moments(std::span<const double> signal) {
  const double largest = largest_magnitude(signal);
  if (largest == 0.0) {
    return {};
  }
  const double scale = power_of_two_below(largest);
  const std::vector<double> samples = scaled(signal, scale);
  const double centre = mean(samples);
  double m2 = 0.0;
  double m3 = 0.0;
  double m4 = 0.0;
  for (const double sample : samples) {
    const double square = (sample - centre) * (sample - centre);
    m2 += square;
    m3 += square * (sample - centre);
    m4 += square * square;
  }
  const double count = static_cast<double>(samples.size());
  const double noise = kRoundingUnits * std::numeric_limits<double>::epsilon() * largest / scale;
  if (m2 <= noise * noise * count) {
    return {};
  }
  return {m3 / count / std::pow(m2 / count, 1.5), m4 * count / (m2 * m2) - 3.0};
}

}  // namespace loopscope::core::hos
