#pragma once

#include <span>

namespace loopscope::core::signal {

/// Turns the median absolute deviation of Gaussian values into their standard deviation.
inline constexpr double kMadToSigma = 1.4826;
/// Of Gaussian values about 0 the share within x times their median magnitude is 0.54 x for small
/// x.
inline constexpr double kNormalDensityAtZero = 0.54;

/// The upper median: the value with half of the others at or below it. `values` holds at least one
/// and no NaN.
[[nodiscard]] double median(std::span<const double> values);

}  // namespace loopscope::core::signal
