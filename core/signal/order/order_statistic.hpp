#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::signal {

/// The value that would stand at `rank` (0 = the smallest) if `values` were sorted. Finds the
/// narrow band of values around it by counting, without comparisons that no processor guesses.
/// No value may be NaN; rank < values.size().
[[nodiscard]] double order_statistic(std::span<const double> values, std::size_t rank);

}  // namespace loopscope::core::signal
