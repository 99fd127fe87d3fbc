#pragma once

#include <span>
#include <vector>

namespace loopscope::core::hos {

/// `signal` (NaN = missing) about its mean without what is slower than 512 samples: cosines of up
/// to as many half periods as 256 goes into its length. What is left of a step of the load, or of a
/// load that wanders twice integrated, no longer returns to a level that depends on where it is,
/// which is what innovations of a nonlinear loop show (innovation_test.hpp).
[[nodiscard]] std::vector<double> without_slow_wander(std::span<const double> signal);

}  // namespace loopscope::core::hos
