#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace loopscope::core::model {

inline constexpr std::size_t kMostNoiseOrder = 3;

/// The noise of a loop as ARMA of order 1 to 3:
///
///     v = C(z) / ((1 - m1 z^-1)(1 - m2 z^-1)(1 - m3 z^-1)) w,   C = 1 + c1 z^-1 + c2 z^-2 + c3 z^-3
///
/// with w white. Order 1 is any mixture of a slow load and white measurement noise (m = 1: a load
/// that wanders without bound); a load that passes the lags of the process first needs order 2 or
/// 3, and its zeros come in complex pairs. Poles are real on purpose: a noise model that can
/// oscillate explains every limit cycle away.
struct NoiseModel {
  std::size_t order = 1;
  std::array<double, kMostNoiseOrder> poles{0.95, 0.0, 0.0};   ///< m, -0.95 to 1
  std::array<double, kMostNoiseOrder> zeros{-0.3, 0.0, 0.0};   ///< c, invertible
};

/// The noise with one more pole and one more real zero.
[[nodiscard]] NoiseModel extended(const NoiseModel& noise, double pole, double zero);

/// Draws the zeros in until all lie within 0.985 of the origin.
void make_invertible(NoiseModel& noise);

/// Columns stored row by row, padded to whole vectors, so that a recursion in time runs over all
/// columns at once.
inline constexpr std::size_t kMaxColumns = 24;

/// w = v filtered by the inverse of the noise model, for every column of a row-major table of
/// `width` columns (<= kMaxColumns, a multiple of 4), in place. Before the record everything was as
/// in its first row.
void whiten(const NoiseModel& noise, std::span<double> table, std::size_t width);

}  // namespace loopscope::core::model
