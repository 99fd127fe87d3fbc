#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace loopscope::core::model {

inline constexpr std::size_t kMostNoiseOrder = 3;

/// The noise of a loop as ARMA of order 1 to 3:
///
///     v = C(z) / ((1 - m1 z^-1)(1 - m2 z^-1)(1 - m3 z^-1)) w,   C = 1 + c1 z^-1 + c2 z^-2 + c3
///     z^-3
///
/// with w white. Order 1 is any mixture of a slow load and white measurement noise (m = 1: a load
/// that wanders without bound); a load that passes the lags of the process first needs order 2 or
/// 3, and its zeros come in complex pairs. Poles are real on purpose: a noise model that can
/// oscillate explains every limit cycle away.
struct NoiseModel {
  std::size_t order = 1;
  std::array<double, kMostNoiseOrder> poles{0.95, 0.0, 0.0};  ///< m, -0.95 to 1
  std::array<double, kMostNoiseOrder> zeros{-0.3, 0.0, 0.0};  ///< c, invertible
};

/// m as coefficients: those of (1 - m1 z^-1)(1 - m2 z^-1)(1 - m3 z^-1) after the leading 1.
[[nodiscard]] std::array<double, kMostNoiseOrder> autoregression(const NoiseModel& noise);

/// The noise with one more pole and one more real zero; as it is at order 3.
[[nodiscard]] NoiseModel extended(const NoiseModel& noise, double pole, double zero);

/// Draws the zeros in until all lie within 0.985 of the origin.
void make_invertible(NoiseModel& noise);

/// w = v filtered by the inverse of the noise model; before the record everything was as in its
/// first sample. Equal lengths; `v` and `w` may be the same.
void whiten(const NoiseModel& noise, std::span<const double> v, std::span<double> w);

/// Two signals at the time of one.
void whiten(const NoiseModel& noise, std::array<std::span<const double>, 2> v,
            std::array<std::span<double>, 2> w);

/// After so many samples whitening has forgotten a signal that ended, but for rounding; the largest
/// number where it remembers longer than is worth knowing.
[[nodiscard]] std::size_t whitening_memory(const NoiseModel& noise);

/// What whitening makes of a constant 1; 0 with a pole at 1.
[[nodiscard]] double whitened_level(const NoiseModel& noise);

}  // namespace loopscope::core::model
