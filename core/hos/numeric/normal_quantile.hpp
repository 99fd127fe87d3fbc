#pragma once

namespace loopscope::core::hos {

/// The z that a standard normal variable exceeds with probability `alpha` (c_alpha^z of eq. 10):
/// 1.6448536... for 0.05. `alpha` within 1e-300 to 0.5; full double precision.
[[nodiscard]] double upper_normal_quantile(double alpha);

}  // namespace loopscope::core::hos
