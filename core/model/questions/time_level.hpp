#pragma once

#include "core/model/questions/answer.hpp"
#include "core/model/questions/questioned.hpp"

namespace loopscope::core::model {

/// "time_level": does the mean of the residual change over time (change_point.hpp)? Says whether a
/// step or a drift fits better. Nominates load_step for a step.
[[nodiscard]] Answer ask_time_level(const Questioned& questioned);

}  // namespace loopscope::core::model
