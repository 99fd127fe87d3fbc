#pragma once

#include <span>

#include "core/diagnosis/evidence/figure.hpp"

namespace loopscope::core::diagnosis {

/// What the loop model took in, asked for and left: the steps of its explanation, the residual
/// tests before and after.
[[nodiscard]] std::span<const Figure> step_figures();

}  // namespace loopscope::core::diagnosis
