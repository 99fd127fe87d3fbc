#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::hos {

/// Amplitudes of the fundamental and the third harmonic in every segment, by least squares.
///
/// In each segment of 1.75 periods the signal is fitted, with Hann weights, by a parabola and the
/// harmonics f, 2f and 3f: what drifts and what wobbles slower than the segment ends in the
/// parabola instead of leaking into both amplitudes and faking a coupling between them. The fit is
/// linear, so that each amplitude is one complex filter over the segment.
class HarmonicFilters {
 public:
  /// `period` in samples, at least kShortestPeriod of period.hpp.
  explicit HarmonicFilters(double period);

  /// One entry per segment without a missing sample (NaN or infinity).
  struct Amplitudes {
    std::vector<std::complex<double>> fundamental;
    std::vector<std::complex<double>> third;
    std::vector<std::size_t> positions;  ///< of the segments, in hops from the start
  };
  [[nodiscard]] Amplitudes apply(std::span<const double> signal) const;

  /// The sample in the middle of the segment at a position.
  [[nodiscard]] std::size_t centre(std::size_t position) const {
    return position * hop_ + length() / 2;
  }

  /// E[a_s a*_{s+d}] / E|a_s|^2 of the third harmonic's amplitude in white noise, d in hops.
  [[nodiscard]] std::vector<std::complex<double>> noise_correlation() const;

 private:
  [[nodiscard]] std::size_t length() const { return static_cast<std::size_t>(taps_.rows()); }

  std::size_t hop_ = 1;
  /// Columns: cosine and minus sine amplitude of the fundamental, the same of the third harmonic.
  Eigen::Matrix<double, Eigen::Dynamic, 4> taps_;
};

}  // namespace loopscope::core::hos
