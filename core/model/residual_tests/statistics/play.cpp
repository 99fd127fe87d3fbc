#include "core/model/residual_tests/statistics/play.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loopscope::core::model {

std::vector<double> lag_of_play(std::span<const double> op_percent, double width_percent) {
  const double half = 0.5 * width_percent;
  std::vector<double> lag(op_percent.size(), std::numeric_limits<double>::quiet_NaN());
  double position = lag.empty() ? 0.0 : lag.front();
  for (std::size_t k = 0; k < lag.size(); ++k) {
    const double op = op_percent[k];
    if (!std::isfinite(op)) continue;
    position = std::isnan(position) ? op : std::clamp(position, op - half, op + half);
    lag[k] = position - op;
  }
  return lag;
}

}  // namespace loopscope::core::model
