#pragma once

#include <span>
#include <vector>

namespace loopscope::daemon {

/// Which of many tests are flagged.
struct FalseDiscovery {
  double threshold = 0.0;     ///< p-values up to this are flagged; 0 when none is
  std::vector<bool> flagged;  ///< one per p-value
};

/// Benjamini and Hochberg (1995) at `rate` over the p-values, NaN = not tested. Stands in for
/// core/plant/false_discovery.hpp, which has the same interface.
[[nodiscard]] FalseDiscovery control_false_discovery(std::span<const double> p, double rate);

}  // namespace loopscope::daemon
