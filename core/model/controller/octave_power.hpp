#pragma once

#include <span>
#include <vector>

namespace loopscope::core::model {

/// How much a signal moves in one octave of frequencies.
struct OctavePower {
  double low = 0.0;    ///< radians per sample
  double high = 0.0;   ///< 2 low
  double power = 0.0;  ///< half the mean square of moves from block to block, signal units squared
  double share = 0.0;  ///< of the power of all octaves, 0 to 1
};

/// Means of neighbours, two by two; NaN where one is missing.
[[nodiscard]] std::vector<double> halved(const std::vector<double>& blocks);

/// Power of a signal octave by octave (Haar wavelets), fastest first, from pi down to about eight
/// cycles in the record. NaN = missing: blocks that touch a gap are left out. Empty when nothing
/// moves.
[[nodiscard]] std::vector<OctavePower> octave_powers(std::span<const double> signal);

}  // namespace loopscope::core::model
