#pragma once

#include <span>
#include <vector>

namespace loopscope::core::model {

/// Sign of op's last motion beyond its noise (two median steps), sample by sample: +1 or -1; 0
/// until it has moved so far. Where op (any unit) is missing, NaN, it has not moved.
[[nodiscard]] std::vector<double> move_direction(std::span<const double> op);

}  // namespace loopscope::core::model
