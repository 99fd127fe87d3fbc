#pragma once

#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// The verdict of a loop whose error this effect explains most.
[[nodiscard]] VerdictCode verdict_of(model::EffectKind effect);

/// The same of a step: play in a loop that cycles about it ends as a valve that sticks; a load that
/// moves when the loop answers its setpoint stands for something that the model does not know.
[[nodiscard]] VerdictCode verdict_of(const model::Step& step);

}  // namespace loopscope::core::diagnosis
