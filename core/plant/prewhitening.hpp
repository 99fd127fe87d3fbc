#pragma once

#include <span>
#include <vector>

namespace loopscope::core::plant {

/// What is left of each value when a line through the two before it (least squares over the record)
/// is taken off: white where the series is of second order. NaN = missing; a value is unknown (NaN)
/// where one of the three is. Fewer than eight complete triples, or none that varies: all unknown.
[[nodiscard]] std::vector<double> without_own_past(std::span<const double> values);

}  // namespace loopscope::core::plant
