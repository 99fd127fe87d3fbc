#include "core/loop/horch.hpp"

#include <algorithm>
#include <cmath>

#include "core/loop/zero_crossings.hpp"

namespace loopscope::core::loop {

std::optional<HorchFigures> measure_horch(const Correlation& op_pv, double period) {
  const auto origin = static_cast<double>(op_pv.max_lag);
  const std::vector<double> crossings = find_zero_crossings(op_pv.values);
  // A crossing exactly at lag 0 counts as the left one.
  const auto right = std::upper_bound(crossings.begin(), crossings.end(), origin);
  if (right == crossings.begin() || right == crossings.end()) return std::nullopt;
  const double tl = origin - *(right - 1);
  const double tr = *right - origin;
  if (tl > period || tr > period) return std::nullopt;

  double largest = 0.0;
  for (auto lag = -static_cast<std::ptrdiff_t>(tl); lag <= static_cast<std::ptrdiff_t>(tr); ++lag) {
    largest = std::max(largest, std::abs(op_pv.at(lag)));
  }
  const double r0 = std::abs(op_pv.at(0));
  if (!(largest > 0.0)) return std::nullopt;
  return HorchFigures{std::abs(tl - tr) / (tl + tr), (largest - r0) / (largest + r0)};
}

}  // namespace loopscope::core::loop
