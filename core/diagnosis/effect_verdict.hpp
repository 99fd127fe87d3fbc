#pragma once

#include "core/diagnosis/verdict.hpp"
#include "core/model/effect_kind.hpp"
#include "core/model/explanation.hpp"

namespace loopscope::core::diagnosis {

/// The verdict of a loop whose error this effect explains most.
[[nodiscard]] VerdictCode verdict_of(model::EffectKind effect);

/// The same of a step: play in a loop that cycles about it ends as a valve that sticks; a load that
/// moves when the loop answers its setpoint stands for something that the model does not know.
[[nodiscard]] VerdictCode verdict_of(const model::Step& step);

/// Valve and sensor faults: the findings of a controller behind one say nothing of its tuning, so
/// that advice on tuning waits until the fault is mended.
[[nodiscard]] bool withholds_tuning(VerdictCode code);

}  // namespace loopscope::core::diagnosis
