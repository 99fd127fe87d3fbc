#pragma once

#include <string>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/odds/cause_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The summary of a valve that sticks where the model found dead band instead: the two look alike
/// in a loop that cycles; empty where the catalogue's holds.
[[nodiscard]] std::string valve_summary(VerdictCode code, const Evidence& evidence);

/// Why such a valve is said to stick rather than to have dead band: what weighed most between the
/// two by the newest window, `alone`, and how probable each is; that they can hardly be told apart
/// where dead band is as probable as `line` (0 to 1). Empty where valve_summary() is.
[[nodiscard]] std::string why_stiction(VerdictCode code, const Evidence& evidence,
                                       const Causes& alone, double line);

/// What to do about a valve that sticks, with steps of the output that fit the band found.
[[nodiscard]] std::string stroke_test_action(const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
