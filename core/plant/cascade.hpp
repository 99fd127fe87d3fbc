#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant {

/// A loop whose output is another loop's setpoint.
struct CascadePair {
  std::size_t master = 0;    ///< index in the loops that were given
  std::size_t slave = 0;     ///< likewise
  double correlation = 0.0;  ///< of the moves of setpoint and output, -1 to 1
  double lag_s = 0.0;        ///< the setpoint comes so much later than the output
};

/// Smallest |correlation| of a setpoint and the output that writes it.
inline constexpr double kCascadeCorrelation = 0.99;

/// Pairs of which the slave's setpoint moves at more than half of the times that both were sampled,
/// and equals the master's output, scaled, within two of the coarser sample interval. Every slave
/// has one master: the one of largest correlation. Loops without sp or op, with fewer than 64 moves
/// of them or fewer than 64 times in common are left out. Sample intervals, starts and lengths may
/// differ.
[[nodiscard]] std::vector<CascadePair> find_cascade_pairs(std::span<const MemberLoop> loops);

}  // namespace loopscope::core::plant
