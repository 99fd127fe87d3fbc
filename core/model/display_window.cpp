#include "core/model/display_window.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/model/valve_law/op_turns.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kCycles = 6.0;
/// A picture of a hand's width tells so many samples apart.
constexpr double kShortestStretch = 200.0;
constexpr double kLongest = 600.0;

double six_cycles(std::span<const double> op) {
  const auto spread = signal::measure_spread(op);
  const std::size_t turns = spread ? find_op_turns(op, spread->std).size() : 0;
  const double cycles = std::max(1.0, 0.5 * static_cast<double>(turns));
  return kCycles * static_cast<double>(op.size()) / cycles;
}

/// Sums over `length` values to each side, half of them before.
std::vector<double> sums_about(const std::vector<double>& values, std::size_t length) {
  std::vector<double> before(values.size() + 1, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) before[k + 1] = before[k] + values[k];
  std::vector<double> sums(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t first = k - std::min(k, length / 2);
    sums[k] = before[std::min(values.size(), k + length / 2 + 1)] - before[first];
  }
  return sums;
}

/// A sum of sums weighs by a triangle.
std::size_t middle_of(std::span<const double> gain, std::size_t length) {
  std::vector<double> values(gain.begin(), gain.end());
  std::ranges::replace_if(
      values, [](double value) { return std::isnan(value); }, 0.0);
  const std::vector<double> weighed = sums_about(sums_about(values, length / 2), length / 2);
  const auto best = std::ranges::max_element(weighed);
  if (best == weighed.end() || !(*best > 0.0)) return gain.size() / 2;
  return static_cast<std::size_t>(best - weighed.begin());
}

}  // namespace

Range telling_stretch(std::span<const double> op, std::span<const double> gain,
                      std::size_t fewest) {
  const auto asked =
      static_cast<std::size_t>(std::clamp(six_cycles(op), kShortestStretch, kLongest));
  const std::size_t length = std::min(gain.size(), std::max(asked, fewest));
  const std::size_t middle = middle_of(gain, length);
  const std::size_t from = std::min(middle - std::min(middle, length / 2), gain.size() - length);
  return {from, from + length};
}

}  // namespace loopscope::core::model
