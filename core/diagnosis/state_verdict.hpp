#pragma once

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/loop_state.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::diagnosis {

/// The verdict of a state that the data show: `sensor_fault`, `valve_saturation` or
/// `not_controlling`, with the state first among the reasons and what else was measured behind. The
/// first two raise the log odds of their cause by state_evidence() and stand alone. `state` is not
/// LoopState::none.
[[nodiscard]] Verdict verdict_of_state(LoopState state, const Evidence& evidence,
                                       const hos::Settings& settings,
                                       const DecisionSettings& decision);

}  // namespace loopscope::core::diagnosis
