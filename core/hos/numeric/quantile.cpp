#include "core/hos/numeric/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace loopscope::core::hos {
double sample_quantile(std::span<const double> sorted, double probability) {
  if (sorted.empty()) {
    throw std::invalid_argument("quantile of no values");
  }
  const double position = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

}  // namespace loopscope::core::hos
