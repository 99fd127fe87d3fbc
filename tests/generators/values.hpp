#pragma once

#include <cmath>
#include <numeric>
#include <vector>

namespace loopscope::tests::generators {

/// As a converter or a historian reports it: the nearest multiple of `grid`; 0 = the value itself.
[[nodiscard]] inline double to_grid(double value, double grid) {
  return grid > 0.0 ? grid * std::round(value / grid) : value;
}

[[nodiscard]] inline double standard_deviation(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / count);
}

}  // namespace loopscope::tests::generators
