#pragma once

#include "core/simulate/loop.hpp"

namespace loopscope::core::simulate {

/// Loops as plants have them, for demonstrations and tests. Their loads wander within bounds and
/// their transmitters are noisy; the paper's are neither. Each function returns the settings for a
/// record of `samples` (>= 1) at an interval > 0, which simulate_loop() checks.
struct Recording {
  std::size_t samples = 4096;
  double sample_interval_s = 1.0;
};

[[nodiscard]] LoopSettings healthy_flow(const Recording& recording);
[[nodiscard]] LoopSettings tight_tuning(const Recording& recording);
[[nodiscard]] LoopSettings sluggish_tuning(const Recording& recording);
[[nodiscard]] LoopSettings sticking_valve(const Recording& recording);
[[nodiscard]] LoopSettings square_limit_cycle(const Recording& recording);
[[nodiscard]] LoopSettings deadband(const Recording& recording);
[[nodiscard]] LoopSettings oversized_valve(const Recording& recording);
[[nodiscard]] LoopSettings saturated_valve(const Recording& recording);
[[nodiscard]] LoopSettings worn_valve(const Recording& recording);
[[nodiscard]] LoopSettings nonlinear_process(const Recording& recording);
[[nodiscard]] LoopSettings process_gain_change(const Recording& recording);
[[nodiscard]] LoopSettings outside_oscillation(const Recording& recording);
[[nodiscard]] LoopSettings load_upsets(const Recording& recording);
[[nodiscard]] LoopSettings quantised_sensor(const Recording& recording);
[[nodiscard]] LoopSettings holding_sensor(const Recording& recording);
[[nodiscard]] LoopSettings level_loop(const Recording& recording);
[[nodiscard]] LoopSettings sticking_level(const Recording& recording);

}  // namespace loopscope::core::simulate
