#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::model {

/// The grid that recorded values lie on.
struct ValueGrid {
  double p = 1.0;          ///< that a continuous signal shows this
  double step = 0.0;       ///< value units; 0 = no grid
  std::size_t levels = 0;  ///< that occur more than once
};

/// A step below this share of the fast noise adds less than 0.2 % to its variance.
inline constexpr double kHarmlessStep = 0.15;
/// Two values closer than this share of the fast noise are one.
inline constexpr double kSameValue = 1e-5;

/// Values that occur more than once, up to `noise_std` / 100 000, are levels. When nine tenths of
/// the samples are on levels and the distances between levels are multiples of a step (the phases
/// of the levels on it have a resultant R of at least 0.95), the p is that of Rayleigh's test over
/// the levels and of every return to a level, which a continuous signal makes with probability
/// below 1/e: exp(-levels R^2 - returns), times the steps that the range holds. Values off the grid
/// (interpolated ones) and rounding noise of the values do no harm.
[[nodiscard]] ValueGrid find_grid(std::span<const double> values, double noise_std);

}  // namespace loopscope::core::model
