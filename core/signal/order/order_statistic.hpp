#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::signal {

/// The value that would stand at `rank` (0 = the smallest) if `values` were sorted. Finds the
/// narrow band of values around it by counting, without comparisons that no processor guesses.
/// No value may be NaN; rank < values.size().
[[nodiscard]] double order_statistic(std::span<const double> values, std::size_t rank);

/// Turns the median absolute deviation of Gaussian values into their standard deviation.
inline constexpr double kMadToSigma = 1.4826;
/// Of Gaussian values about 0 the share within x times their median magnitude is 0.54 x for small
/// x.
inline constexpr double kNormalDensityAtZero = 0.54;

/// The upper median: the value with half of the others at or below it. `values` holds at least one
/// and no NaN.
[[nodiscard]] double median(std::span<const double> values);

}  // namespace loopscope::core::signal
