#pragma once

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::tests::verdict {

/// What the verdict may name, worked out anew from the evidence.

[[nodiscard]] bool is_fault(core::diagnosis::VerdictCode code);
[[nodiscard]] bool blames(core::diagnosis::VerdictCode code, core::plant::Fault fault);
[[nodiscard]] bool is_valve(core::diagnosis::VerdictCode code);
[[nodiscard]] bool has_step(const core::Evidence& evidence, core::model::EffectKind effect);

/// op is at no limit of its range, rests at no end of its travel, and no step holds it.
[[nodiscard]] bool is_at_no_limit(const core::Evidence& evidence);

/// A cause of its own that the data can show; sizes of valves apart.
[[nodiscard]] bool may_be_named(core::diagnosis::VerdictCode code, const core::Evidence& evidence);

}  // namespace loopscope::tests::verdict
