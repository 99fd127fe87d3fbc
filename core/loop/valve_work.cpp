#include "core/loop/valve_work.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::loop {
namespace {

constexpr double kRelativeTolerance = 1e-6;

}  // namespace

double move_tolerance(std::span<const double> positions) {
  double largest = 0.0;
  for (const double value : positions) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return kRelativeTolerance * largest;
}

ValveWork measure_valve_work(std::span<const double> op) {
  const double tolerance = move_tolerance(op);
  ValveWork work;
  double direction = 0.0;
  for (std::size_t k = 1; k < op.size(); ++k) {
    const double move = op[k] - op[k - 1];
    if (!std::isfinite(move)) continue;
    ++work.pairs;
    work.travel += std::abs(move);
    if (std::abs(move) <= tolerance) continue;
    if (move * direction < 0.0) work.reversals += 1.0;
    direction = std::copysign(1.0, move);
  }
  return work;
}

}  // namespace loopscope::core::loop
