#pragma once

#include <span>

namespace loopscope::core::hos {

/// The value below which a share `probability` (0 to 1) of `sorted` (ascending) lies, interpolated
/// between order statistics: 0 is the smallest value, 1 the largest. Throws std::invalid_argument
/// for no values; order and range are not checked.
[[nodiscard]] double sample_quantile(std::span<const double> sorted, double probability);

}  // namespace loopscope::core::hos
