#pragma once

#include <cstddef>
#include <vector>

#include "daemon/reproduce/example.hpp"
#include "daemon/reproduce/measure.hpp"

namespace loopscope::daemon {

/// An example and what was measured of it.
struct MeasuredExample {
  Example example;
  Measurement measurement;
};

/// All examples of the paper over a number of seeds.
struct Reproduction {
  std::size_t seeds = 0;
  std::vector<MeasuredExample> examples;
};

/// Measures every example with seeds 1 to `seeds` (>= 1).
[[nodiscard]] Reproduction reproduce_paper(std::size_t seeds);

}  // namespace loopscope::daemon
