#pragma once

#include <optional>

#include "core/diagnosis/case.hpp"
#include "core/diagnosis/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The branch of the flow for loops whose model is excited and took in effects that no recorded
/// fact refutes: the verdict of the effect that explains most, the other effects as reasons; of
/// loops without such effects stepless_verdict().
///
/// `loop.evidence.model` is filled and excited. Verdict::p is the p of the leading step. Wave
/// shapes and cross-correlation have no say: an outside sinusoid is odd, too (paper, section 5.3).
[[nodiscard]] Verdict model_verdict(const Case& loop);

/// What a model that is not excited knows all the same: loads and waves that came from outside need
/// no word on the way from op to pv. nullopt where it took in none. Steps that need that way are
/// left out and named.
[[nodiscard]] std::optional<Verdict> outside_verdict(const Case& loop);

}  // namespace loopscope::core::diagnosis
