#pragma once
/// Numbers that tests of every room need.

#include <cstddef>
#include <limits>
#include <numbers>

namespace loopscope::tests {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kTurn = 2.0 * std::numbers::pi;  // radians

/// Samples of the window that is analysed unless a loop's settings say otherwise.
inline constexpr std::size_t kWindow = 4096;

}  // namespace loopscope::tests
