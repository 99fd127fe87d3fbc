#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::plant {

/// A loop and how probable it is that one which knows nothing of an oscillation follows it so well.
struct Neighbour {
  std::size_t index = 0;  ///< in the loops that were given
  double p = 1.0;         ///< Following::p
};

/// One loop and those that follow its oscillation.
struct Hub {
  std::size_t centre = 0;
  std::vector<std::size_t> neighbours;  ///< best first; empty = nothing was found
  /// That independent loops show such a hub: the chance of so many of the neighbours below the
  /// worst p of the hub, times the sizes that were looked at.
  double p = 1.0;
};

/// The least likely of the stars about one centre.
[[nodiscard]] Hub find_hub(std::size_t centre, std::vector<Neighbour> around);

}  // namespace loopscope::core::plant
