#pragma once

#include <optional>
#include <span>

#include "core/hos/segment_levels.hpp"

namespace loopscope::core::hos {

/// Phase coupling of an oscillation with its own harmonics, on segments that fit its period:
/// f + f -> 2f (a point on the diagonal of the bispectrum) and f + f + f -> 3f (of the
/// trispectrum). The second sees the odd-symmetric limit cycles (square, triangle: most of real
/// stiction) whose bispectrum is zero.
struct HarmonicStatistics {
  double period_samples = 0.0;  ///< of the fundamental
  /// -ln p against Gaussian noise around 2f and 3f (coherence_test.hpp).
  double quadratic_evidence = 0.0;
  double cubic_evidence = 0.0;
};

/// Coherence of the fundamental's amplitude squared (cubed) with the second (third) harmonic's,
/// over segments of 1.75 periods. `period` in samples; `levels`, if any, of the signal: each
/// segment is divided by the level at its centre. nullopt with fewer than four complete segments.
[[nodiscard]] std::optional<HarmonicStatistics> harmonic_statistics(
    std::span<const double> signal, double period, const SegmentLevels* levels = nullptr);

}  // namespace loopscope::core::hos
