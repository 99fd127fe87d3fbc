#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant {

/// Samples of a period, and periods of a record, with which an oscillation can be followed.
inline constexpr double kShortestPeriod = 3.5;
inline constexpr double kFewestPeriods = 8.0;

/// Periods between two points of an envelope.
inline constexpr double kEnvelopeStep = 1.0;

/// How an oscillation about one frequency grows, fades and slips, on a grid of absolute time that
/// all loops share whatever their sampling: point j lies at j * step_s since 1970.
struct Envelope {
  double frequency_hz = 0.0;  ///< that was taken off
  std::int64_t first = 0;     ///< number of the first point
  /// z, pv units, with error(t) = 2 Re(z(t) exp(2 pi i f t)); NaN where too little was recorded.
  /// Single precision, far below any noise: the search holds those of ten thousand loops.
  std::vector<std::complex<float>> points;

  [[nodiscard]] double step_s() const { return kEnvelopeStep / frequency_hz; }
  [[nodiscard]] std::int64_t end() const {
    return first + static_cast<std::int64_t>(points.size());
  }
  /// NaN outside.
  [[nodiscard]] std::complex<double> at(std::int64_t point) const;
};

/// The error's fundamental at `frequency_hz` in Hann windows of two periods, the shortest that is
/// blind to the mean and to every further harmonic. `sample_interval_s` > 0, `start_us` of the
/// first sample, microseconds UTC since 1970. Empty when a period is shorter than kShortestPeriod
/// or the record is shorter than kFewestPeriods. Slow oscillations are taken from means of 2, 4, 8
/// ... samples, at least sixteen of which make a period.
[[nodiscard]] Envelope make_envelope(std::span<const double> error, double sample_interval_s,
                                     std::int64_t start_us, double frequency_hz);
[[nodiscard]] Envelope make_envelope(const MemberLoop& loop, double frequency_hz);

}  // namespace loopscope::core::plant
