#pragma once
/// What a valve is asked and where it goes.

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/model/valve_law/valve_law.hpp"
#include "core/simulate/random.hpp"

namespace loopscope::core::model::tests {

/// AR(1) about 50 %; with a grid, also values that stand still.
[[nodiscard]] inline std::vector<double> wandering_op(std::uint64_t seed, double grid = 0.0) {
  simulate::GaussianSource noise(seed);
  std::vector<double> op(2000);
  double state = 0.0;
  for (double& value : op) {
    state = 0.9 * state + noise.next();
    value = grid > 0.0 ? 50.0 + grid * std::round(state / grid) : 50.0 + state;
  }
  return op;
}

[[nodiscard]] inline std::vector<double> positions(const Valve& valve,
                                                   const std::vector<double>& op) {
  std::vector<double> mv(op.size());
  run_valve(valve, op, mv);
  return mv;
}

}  // namespace loopscope::core::model::tests
