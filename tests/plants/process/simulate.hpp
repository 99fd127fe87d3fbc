#pragma once

#include <cstddef>
#include <vector>

#include "tests/plants/process/plan.hpp"

namespace loopscope::tests::process {

/// What is kept of one loop: every `every`-th step until `end_early` steps before the last.
struct Window {
  std::size_t samples = 0;
  long every = 1;
  long end_early = 0;
};

struct Record {
  double interval_s = 1.0;
  double start_s = 0.0;
  std::vector<double> sp, pv, op;
};

/// The plant in time, after the plan's settling; a window per loop. Empty when a measured value
/// leaves its span: a plant that has run away.
[[nodiscard]] std::vector<Record> simulate(const PlantPlan& plan,
                                           const std::vector<Window>& windows);

/// The same window for every loop.
[[nodiscard]] std::vector<Record> simulate(const PlantPlan& plan, Window window);

}  // namespace loopscope::tests::process
