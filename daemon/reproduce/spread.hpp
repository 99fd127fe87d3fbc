#pragma once

#include <vector>

namespace loopscope::daemon {

/// How a figure spreads over the seeds.
struct Spread {
  double median = 0.0;
  double p10 = 0.0;  ///< 10th percentile, interpolated between order statistics
  double p90 = 0.0;  ///< 90th percentile
  double min = 0.0;
  double max = 0.0;
};

/// Spread of at least one value; throws std::invalid_argument for none.
[[nodiscard]] Spread spread_of(std::vector<double> values);

}  // namespace loopscope::daemon
