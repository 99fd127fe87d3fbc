#pragma once

#include "core/diagnosis/case.hpp"
#include "core/diagnosis/contradiction.hpp"
#include "core/diagnosis/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The verdict on a loop whose model is excited and needs no effect: what oscillates at the implied
/// loop's own period is tuning, at another period comes from outside; a loop far slower than its
/// process allows is sluggish; else what is left decides between unexplained and healthy.
/// `story` is that of the loop; its explanation has no steps.
[[nodiscard]] Verdict stepless_verdict(const Case& loop, const BelievedExplanation& story);

}  // namespace loopscope::core::diagnosis
