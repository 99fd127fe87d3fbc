#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// A sinusoid that stands out of the spectrum.
struct SpectralLine {
  double p = 1.0;               ///< among all frequencies looked at
  double period_samples = 0.0;  ///< 2 to samples / 6
  double amplitude = 0.0;       ///< signal units
};

inline constexpr std::size_t kMostLines = 3;

/// The strongest lines of a signal against its own coloured noise, strongest first, at most
/// kMostLines, those with p <= 0.05.
///
/// Hann window over the whole record (gaps of up to 20 samples bridged, straight line removed,
/// other missing samples 0), transform of two to four times its length. The noise beside a
/// frequency is read from the logarithms of the power in a band on either side: a power law leaves
/// no line. A line is read at the vertex of the parabola through three logarithms of power. What a
/// stronger line leaks counts as noise. Empty when fewer than 200 samples are finite or the signal
/// is constant.
struct LineSearch {
  double p = 1.0;  ///< of the strongest line, significant or not
  std::vector<SpectralLine> lines;
};
[[nodiscard]] LineSearch find_lines(std::span<const double> signal);

}  // namespace loopscope::core::model
