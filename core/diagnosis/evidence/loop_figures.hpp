#pragma once

#include <span>

#include "core/diagnosis/evidence/figure.hpp"

namespace loopscope::core::diagnosis {

/// What is known of the loop as a whole: the closed loop implied by the model, oscillation,
/// performance, higher-order statistics, data.
[[nodiscard]] std::span<const Figure> loop_figures();

/// How long the error remembers by integral time and longest plausible delay: what a loop with a
/// gain to speak of needs to make up for a load; dimensionless. nullopt without a model or its
/// controller, without integral action or a memory, or of a vessel.
[[nodiscard]] std::optional<double> memory_by_controller(const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
