#pragma once

#include <cstddef>
#include <vector>

#include "tests/plants/network/plan.hpp"

namespace loopscope::tests::network {

/// What was recorded of one loop; % of span.
struct LoopRecord {
  double interval_s = 1.0;
  double start_s = 0.0;
  std::vector<double> sp, pv, op;
};

inline constexpr std::size_t kSamples = 4096;  ///< of a window

/// The loops together, in one time, after a run-in. Empty when a pv leaves its span.
[[nodiscard]] std::vector<LoopRecord> simulate(const PlantPlan& plan,
                                               std::size_t samples = kSamples);

}  // namespace loopscope::tests::network
