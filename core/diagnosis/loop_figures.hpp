#pragma once

#include <span>

#include "core/diagnosis/figure.hpp"

namespace loopscope::core::diagnosis {

/// What is known of the loop as a whole: the closed loop implied by the model, oscillation,
/// performance, higher-order statistics, data.
[[nodiscard]] std::span<const Figure> loop_figures();

}  // namespace loopscope::core::diagnosis
