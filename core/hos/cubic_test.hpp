#pragma once

#include <optional>
#include <span>

#include "core/hos/segment_levels.hpp"

namespace loopscope::core::hos {

/// Cubic phase coupling f + f + f -> 3f at the signal's dominant period: a point on the diagonal of
/// the trispectrum. It sees the odd-symmetric limit cycles (square, triangle: most of real
/// stiction) whose bispectrum is zero.
struct CubicStatistics {
  double period_samples = 0.0;  ///< of the fundamental
  double evidence = 0.0;        ///< -ln p against Gaussian noise around 3f (coherence_test.hpp)
};

/// Coherence of the cube of the fundamental's amplitude with the third harmonic's, over segments of
/// 1.75 periods. `period` in samples; `levels`, if any, of the signal: each segment is divided by
/// the level at its centre. nullopt with fewer than four complete segments.
[[nodiscard]] std::optional<CubicStatistics> cubic_statistics(
    std::span<const double> signal, double period, const SegmentLevels* levels = nullptr);

}  // namespace loopscope::core::hos
