#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant {

/// Periods between two points of an envelope.
inline constexpr double kEnvelopeStep = 1.0;

/// How an oscillation about one frequency grows, fades and slips, on a grid of absolute time that
/// all loops share whatever their sampling: point j lies at j * step_s since 1970.
struct Envelope {
  double frequency_hz = 0.0;  ///< that was taken off
  std::int64_t first = 0;     ///< number of the first point
  /// z with error(t) = 2 Re(z(t) exp(2 pi i f t)); NaN where too little was recorded.
  std::vector<std::complex<double>> points;

  [[nodiscard]] double step_s() const { return kEnvelopeStep / frequency_hz; }
  [[nodiscard]] std::int64_t end() const {
    return first + static_cast<std::int64_t>(points.size());
  }
  /// NaN outside.
  [[nodiscard]] std::complex<double> at(std::int64_t point) const;
};

/// The error's fundamental at `frequency_hz` in Hann windows of three periods: the zeros of such a
/// window lie at the mean and at every further harmonic. Empty when a period is shorter than four
/// samples or the record is shorter than eight periods.
[[nodiscard]] Envelope make_envelope(const MemberLoop& loop, double frequency_hz);

}  // namespace loopscope::core::plant
