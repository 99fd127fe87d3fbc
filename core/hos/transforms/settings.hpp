#pragma once

#include <cstddef>
#include <string_view>

namespace loopscope::core::hos {

/// Taper of every segment of N samples, n = 1..N (main lobe: half width in units of 1/N).
enum class WindowShape {
  hann,           ///< the paper's: 0.5 (1 - cos(2 pi n / (N + 1))), no zero at either end; 2
  hann_periodic,  ///< 0.5 (1 - cos(2 pi (n - 1) / N)), zero at the first sample; 2
  hamming,        ///< 0.54 - 0.46 cos(2 pi (n - 1) / (N - 1)); 2
  rectangular,    ///< 1; 1
};
[[nodiscard]] std::string_view name(WindowShape shape);

/// The least and the largest value of a setting, both allowed.
struct Bounds {
  double least;
  double largest;
  /// NaN is not.
  [[nodiscard]] constexpr bool hold(double value) const {
    return value >= least && value <= largest;
  }
};

/// The one place of these ranges: the settings file is held to them as well.
namespace bounds {
inline constexpr Bounds kSegmentLength{16, 4096};
inline constexpr Bounds kOverlap{0.0, 0.9};
inline constexpr Bounds kDftLength{16, 8192};
inline constexpr Bounds kAlpha{0.0001, 0.5};
inline constexpr Bounds kThreshold{0.0, 1.0};
inline constexpr Bounds kMaxPeaks{0, 50};
}  // namespace bounds

/// Settings of the segment-averaged estimates. The defaults are the paper's (section 2, last
/// paragraph: 4096 samples, segments of 64, 50 % overlap, Hanning window of 64, DFT of 128).
struct Settings {
  std::size_t segment_length = 64;  ///< samples, even, kSegmentLength
  double overlap = 0.5;             ///< share of a segment that the next one repeats, kOverlap
  WindowShape window = WindowShape::hann;
  std::size_t dft_length = 128;  ///< samples, even, >= segment_length, kDftLength
  double alpha = 0.05;           ///< significance of the critical value (eq. 10), kAlpha
  double ngi_threshold = 0.001;  ///< the paper's beta: largest NGI that is Gaussian, kThreshold
  double nli_threshold = 0.01;   ///< largest NLI that is linear, kThreshold
  std::size_t max_peaks = 5;     ///< strongest distinct peaks to report, kMaxPeaks
};

/// Throws std::invalid_argument that names the first setting out of its range and the range.
void validate(const Settings& settings);

}  // namespace loopscope::core::hos
