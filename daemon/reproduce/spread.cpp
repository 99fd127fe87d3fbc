#include "daemon/reproduce/spread.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace loopscope::daemon {

namespace {

double quantile(const std::vector<double>& sorted, double probability) {
  const double position = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("spread of no values");
  std::ranges::sort(values);
  return {quantile(values, 0.5), quantile(values, 0.1), quantile(values, 0.9), values.front(),
          values.back()};
}

}  // namespace loopscope::daemon
