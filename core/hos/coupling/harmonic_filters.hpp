#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "core/hos/kernels/kernels.hpp"

namespace loopscope::core::hos {

/// Amplitudes of an oscillation's first three harmonics in every segment, by least squares.
///
/// In each segment of 1.75 periods (24 samples at least) the signal is fitted, with Hann weights,
/// by a parabola and the harmonics f, 2f and 3f: what drifts and what wobbles slower than the
/// segment ends in the parabola instead of leaking into both amplitudes and faking a coupling
/// between them. The fit is linear, so that each amplitude is one complex filter over the segment.
/// A hop is a quarter of a segment.
class HarmonicFilters {
 public:
  /// `period` in samples, at least kShortestPeriod of period.hpp.
  explicit HarmonicFilters(double period);

  /// One entry per segment without a missing sample (NaN or infinity). Amplitude a of harmonic h,
  /// in signal units, stands for Re(a exp(2 pi i h t / period)), t from the segment's centre.
  struct Amplitudes {
    std::array<std::vector<std::complex<double>>, 3> harmonics;  ///< f, 2f, 3f
    std::vector<std::size_t> positions;  ///< of the segments, in hops from the start
  };
  /// No entries for a signal shorter than a segment.
  [[nodiscard]] Amplitudes apply(std::span<const double> signal,
                                 const Kernels& kernels = best_kernels()) const;

  /// The sample in the middle of the segment at a position.
  [[nodiscard]] std::size_t centre(std::size_t position) const {
    return position * hop_ + length() / 2;
  }

  /// E[a_s a*_{s+d}] / E|a_s|^2 of a harmonic's amplitude (1, 2 or 3) in white noise, d in hops.
  [[nodiscard]] std::vector<std::complex<double>> noise_correlation(std::size_t harmonic) const;

 private:
  [[nodiscard]] std::size_t length() const { return static_cast<std::size_t>(taps_.rows()); }

  std::size_t hop_ = 1;
  /// Columns: cosine and minus sine amplitude of each harmonic.
  Eigen::Matrix<double, Eigen::Dynamic, 6> taps_;
};

}  // namespace loopscope::core::hos
