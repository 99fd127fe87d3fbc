#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace loopscope::core::model {

/// The noise of a loop as ARMA with real roots:
///
///     v = (1 - c1 z^-1)(1 - c2 z^-1) / ((1 - m1 z^-1)(1 - m2 z^-1)) w,  w white
///
/// m = c: white measurement noise; m = 1: a load that wanders without bound; between them any
/// mixture of a slow load and white noise. Roots are real on purpose: a noise model that can
/// oscillate explains every limit cycle away.
struct NoiseModel {
  std::array<double, 2> poles{0.95, 0.0};  ///< m, -0.95 to 1
  std::array<double, 2> zeros{0.5, 0.0};   ///< c, -0.95 to 0.98
};

/// w = v filtered by the inverse of the noise model; before the record everything was as in its
/// first sample. Equal lengths; `v` and `w` may be the same.
void whiten(const NoiseModel& noise, std::span<const double> v, std::span<double> w);

/// Two signals at the time of one.
void whiten(const NoiseModel& noise, std::array<std::span<const double>, 2> v,
            std::array<std::span<double>, 2> w);

/// What a constant 1 becomes.
[[nodiscard]] double whitened_level(const NoiseModel& noise);

/// Columns stored row by row, padded to whole vectors, so that a recursion in time runs over all
/// columns at once.
inline constexpr std::size_t kMaxColumns = 24;

/// w = v filtered by the inverse of the noise model, for every column of a row-major table of
/// `width` columns (<= kMaxColumns, a multiple of 4), in place. Before the record everything was as
/// in its first row.
void whiten(const NoiseModel& noise, std::span<double> table, std::size_t width);

}  // namespace loopscope::core::model
