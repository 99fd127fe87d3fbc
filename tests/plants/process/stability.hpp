#pragma once

#include <cstddef>
#include <optional>

#include "tests/plants/process/plan.hpp"

namespace loopscope::tests::process {

/// The gain of one loop from which a quiet copy of the plant (no noise, no upsets, sound valves)
/// swings up by itself after a small step, found by trial; nullopt where sixty times the drawn
/// gain is not enough.
[[nodiscard]] std::optional<double> gain_at_limit(const PlantPlan& plan, std::size_t loop);

}  // namespace loopscope::tests::process
