#pragma once

#include <span>
#include <vector>

namespace loopscope::core::loop {

/// Where a series changes sign, in samples from its start, to a fraction of a sample by a straight
/// line between the nearest values that are not zero. No crossing is reported
/// across a missing sample (NaN).
[[nodiscard]] std::vector<double> find_zero_crossings(std::span<const double> series);

}  // namespace loopscope::core::loop
