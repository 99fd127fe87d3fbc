#include "core/model/op_swings.hpp"

#include <limits>

namespace loopscope::core::model {
namespace {

/// Calls `turned(extreme)` where op turns, once it has moved that far; returns the end of the last
/// swing, and the first value when there was none.
template <typename Turned>
double follow_swings(std::span<const double> op, double swing_percent, Turned turned) {
  double top = op[0];
  double bottom = op[0];
  double direction = 0.0;  // of the last swing; 0 = none yet
  for (const double value : op) {
    top = value > top ? value : top;
    bottom = value < bottom ? value : bottom;
    const bool down = value < top - swing_percent && direction >= 0.0;
    const bool up = value > bottom + swing_percent && direction <= 0.0;
    if (down || up) {
      turned(down ? top : bottom);
      direction = up ? 1.0 : -1.0;
      top = value;
      bottom = value;
    }
  }
  return direction < 0.0 ? bottom : top;
}

double period_over(std::size_t samples, std::span<const double> op, double swing_percent) {
  std::size_t swings = 0;
  if (!op.empty()) {
    follow_swings(op, swing_percent, [&](double) { ++swings; });
  }
  // The first swing has no turn before it.
  return swings > 1 ? 2.0 * static_cast<double>(samples) / static_cast<double>(swings - 1)
                    : std::numeric_limits<double>::infinity();
}

}  // namespace

double swing_period(std::span<const double> op, double swing_percent) {
  return period_over(op.size(), op, swing_percent);
}

OpSwings::OpSwings(std::span<const double> op, double least_percent) : samples_(op.size()) {
  if (op.empty()) return;
  const double last =
      follow_swings(op, least_percent, [&](double extreme) { extremes_.push_back(extreme); });
  extremes_.push_back(last);
}

double OpSwings::period(double swing_percent) const {
  return period_over(samples_, extremes_, swing_percent);
}

}  // namespace loopscope::core::model
