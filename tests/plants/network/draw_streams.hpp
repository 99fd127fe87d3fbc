#pragma once

#include <cstddef>
#include <vector>

#include "tests/effects/random.hpp"
#include "tests/plants/network/plan.hpp"

namespace loopscope::tests::network {

/// The loops of one process unit, by their places in the plan.
struct Unit {
  std::size_t feed = 0;
  std::size_t level = 0;
  std::size_t outflow = 0;
  std::size_t temperature = 0;
  std::size_t steam = 0;
  std::size_t pressure = 0;
  std::size_t reflux = 0;
};

/// What flows within the units, from each to the next, back from the last to the first, and from
/// the supplies of steam and feed (pressure loops), which every consumer pulls down.
[[nodiscard]] std::vector<Stream> draw_streams(const std::vector<Unit>& units, std::size_t steam,
                                               std::size_t feed, effects::Random& random);

}  // namespace loopscope::tests::network
