#pragma once

#include <span>

namespace loopscope::core::signal {

/// Turns the median absolute deviation of Gaussian values into their standard deviation.
inline constexpr double kMadToSigma = 1.4826;

/// The upper median: the value with half of the others at or below it. `values` holds at least one
/// and no NaN.
[[nodiscard]] double median(std::span<const double> values);

}  // namespace loopscope::core::signal
