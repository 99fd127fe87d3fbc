#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/plant/in_step.hpp"
#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant {

/// Natural logarithm of the largest ratio of two periods that may be one oscillation: the period of
/// a noisy record is good to a few percent.
inline constexpr double kSamePeriod = 0.07;

/// Whether the loop's own record shows an oscillation that an event may begin with: it is present,
/// or so regular that only the sampling (half a period below four samples) keeps it from being
/// called so. Filtered noise has a regularity of about 1; at 3 one such loop in twenty passes.
inline constexpr double kClearRegularity = 3.0;
[[nodiscard]] bool may_begin_event(const loop::Oscillation& oscillation);

/// A loop that keeps step with another one.
struct Neighbour {
  std::size_t index = 0;  ///< in the loops that were given
  double p = 1.0;         ///< InStep::p
};

/// For every loop that may begin an event, those of the same period and how well the two keep step;
/// empty for the others. The cost grows with the pairs of one period, not with all pairs.
[[nodiscard]] std::vector<std::vector<Neighbour>> compare_neighbours(
    std::span<const MemberLoop> loops);

/// One loop and those that keep step with it.
struct Star {
  std::size_t centre = 0;
  std::vector<std::size_t> rays;  ///< its neighbours, best first; empty = nothing was found
  /// That independent loops show such a star anywhere: the chance of so many of a centre's
  /// neighbours below the worst p of the star, times the stars and sizes that were looked at.
  double p = 1.0;
};

/// The most significant star of the loops that are not `taken`.
[[nodiscard]] Star find_star(const std::vector<std::vector<Neighbour>>& neighbours,
                             const std::vector<bool>& taken);

}  // namespace loopscope::core::plant
