#pragma once

#include <span>

namespace loopscope::core::hos {

/// The z that a standard normal variable exceeds with probability `alpha` (c_alpha^z of eq. 10):
/// 1.6448536... for 0.05. `alpha` within 1e-300 to 0.5; full double precision.
[[nodiscard]] double upper_normal_quantile(double alpha);

/// The value below which a share `probability` (0 to 1) of `sorted` (ascending) lies, interpolated
/// between order statistics: 0 is the smallest value, 1 the largest. Throws std::invalid_argument
/// for no values.
[[nodiscard]] double sample_quantile(std::span<const double> sorted, double probability);

}  // namespace loopscope::core::hos
