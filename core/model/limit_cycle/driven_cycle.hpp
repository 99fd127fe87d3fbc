#pragma once

#include "core/model/limit_cycle/limit_cycle_cause.hpp"
#include "core/model/record/model_input.hpp"

namespace loopscope::core::model {

/// Whether the setpoint moves enough to drive the loop: a tenth of pv's standard deviation.
[[nodiscard]] bool setpoint_moves(const ModelInput& input);

/// Whether op cycles no more often than such a setpoint turns: then its moves make the cycle, and
/// its shape is theirs. A loop that cycles by itself turns more often.
[[nodiscard]] bool driven_by_setpoint(const ModelInput& input, const CycleEvidence& cycle);

}  // namespace loopscope::core::model
