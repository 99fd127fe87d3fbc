#pragma once

#include <cstddef>
#include <optional>

#include "tests/plants/process/plan.hpp"

namespace loopscope::tests::process {

/// What makes a loop too tight.
enum class Knob { gain, integral_time };

/// The loop with more gain, or less integral time, by `factor`.
[[nodiscard]] LoopPlan tightened(LoopPlan loop, Knob knob, double factor);

/// The factor from which a quiet copy of the plant (no noise, no upsets, sound valves) swings up by
/// itself after a small step, found by trial; nullopt where even 64 is not enough.
[[nodiscard]] std::optional<double> factor_at_limit(const PlantPlan& plan, std::size_t loop,
                                                    Knob knob);

}  // namespace loopscope::tests::process
