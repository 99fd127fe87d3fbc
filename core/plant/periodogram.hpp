#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::plant {

/// The periodogram of one record in a Hann window, its mean and slope taken off.
struct Periodogram {
  std::vector<double> power;  ///< |X|^2 of bin k, signal units squared; 0 at bin 0; empty = none
  double samples = 0.0;       ///< from the first to the last recorded one
  double stretch = 1.0;       ///< length of the transform by that: bin k is k / stretch cycles
};

/// NaN and infinity = missing: cut off at the ends, bridged between. None for fewer than `fewest`
/// samples and for a constant.
[[nodiscard]] Periodogram hann_periodogram(std::span<const double> error, std::size_t fewest);

}  // namespace loopscope::core::plant
