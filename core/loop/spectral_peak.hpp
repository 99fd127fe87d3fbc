#pragma once

#include <optional>

#include "core/loop/record_spectrum.hpp"

namespace loopscope::core::loop {

/// The frequency at which a record holds more power than its neighbourhood explains.
struct SpectralPeak {
  double frequency = 0.0;  ///< centre of the band, cycles per sample
  /// Normal deviate of the power in the band against the background interpolated between the
  /// bands below and above it; any smooth spectrum, also a random walk's, stays near 0.
  double prominence = 0.0;
};

/// The search looks at up to about 150 overlapping bands; with this threshold the whole decision of
/// find_oscillation calls about one record in fifty of smooth noise oscillating (MEASURED.md). At 4
/// it would be one in two hundred, but short records with drift would lose their oscillations.
inline constexpr double kClearProminence = 3.5;

/// Searches `range` on a grid of 3 %. Among the clear peaks the one with the most power above its
/// background is taken, so that the fundamental wins over its harmonics and over noise; without a
/// clear peak it is the most prominent one. nullopt when the range holds no bin.
[[nodiscard]] std::optional<SpectralPeak> find_spectral_peak(const RecordSpectrum& spectrum,
                                                             Band range);

/// Share of the power within `band` that stands above the background around `frequency` (cycles per
/// sample), 0 to 1.
[[nodiscard]] double share_above_background(const RecordSpectrum& spectrum, double frequency,
                                            Band band);

}  // namespace loopscope::core::loop
