#pragma once

#include <span>
#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::loop {

/// Samples at which mv moves, by direction.
struct Branches {
  std::vector<std::size_t> rising;
  std::vector<std::size_t> falling;
};

/// op as the actuator passes it on to the stem: behind the delay (up to 3 samples) and the lag (up
/// to 16 samples) that leave least of mv about two parallel straight lines, one for each branch; op
/// itself where they leave more than half of what op leaves.
///
/// A valve that follows with a lag is behind op on both branches, as far as op is fast: its mv-op
/// plot is as wide as a dead band's, but no dead band is in it. Friction moves the branches apart
/// and leaves each of them a line. `op` and `mv` have one length and one unit, % of the range; NaN
/// = missing (over missing samples of op the lag holds).
[[nodiscard]] signal::Samples behind_actuator(std::span<const double> op,
                                              std::span<const double> mv, const Branches& branches);

}  // namespace loopscope::core::loop
