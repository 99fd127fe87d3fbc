#include "core/loop/zero_crossings.hpp"

#include <cmath>
#include <cstddef>

namespace loopscope::core::loop {

std::vector<double> find_zero_crossings(std::span<const double> series) {
  std::vector<double> crossings;
  double before = 0.0;  // last value that was not zero; 0 = unknown
  std::size_t position = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double value = series[k];
    if (std::isnan(value)) before = 0.0;
    if (std::isnan(value) || value == 0.0) continue;
    if (before != 0.0 && std::signbit(before) != std::signbit(value)) {
      const double fraction = before / (before - value);
      crossings.push_back(static_cast<double>(position) +
                          fraction * static_cast<double>(k - position));
    }
    before = value;
    position = k;
  }
  return crossings;
}

}  // namespace loopscope::core::loop
