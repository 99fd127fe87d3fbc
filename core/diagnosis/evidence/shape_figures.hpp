#pragma once

#include <span>

#include "core/diagnosis/evidence/figure.hpp"

namespace loopscope::core::diagnosis {

/// What the shapes of pv, op and the valve position show: the cycle, rests, travel, plots.
[[nodiscard]] std::span<const Figure> shape_figures();

}  // namespace loopscope::core::diagnosis
