#include "core/model/op_swings.hpp"

#include <cstddef>
#include <limits>

namespace loopscope::core::model {

double swing_period(std::span<const double> op, double swing_percent) {
  if (op.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  double top = op[0];
  double bottom = op[0];
  double direction = 0.0;  // of the last swing; 0 = none yet
  std::size_t turns = 0;
  for (const double value : op) {
    top = value > top ? value : top;
    bottom = value < bottom ? value : bottom;
    const bool down = value < top - swing_percent && direction >= 0.0;
    const bool up = value > bottom + swing_percent && direction <= 0.0;
    if (down || up) {
      turns += direction != 0.0 ? 1U : 0U;
      direction = up ? 1.0 : -1.0;
      top = value;
      bottom = value;
    }
  }
  return turns > 0 ? 2.0 * static_cast<double>(op.size()) / static_cast<double>(turns)
                   : std::numeric_limits<double>::infinity();
}

}  // namespace loopscope::core::model
