#pragma once

#include <string>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The summary of a valve that sticks where the model found dead band instead: the two look alike
/// in a loop that cycles; empty where the catalogue's holds.
[[nodiscard]] std::string valve_summary(VerdictCode code, const Evidence& evidence);

/// What to do about a valve that sticks, with steps of the output that fit the band found.
[[nodiscard]] std::string stroke_test_action(const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
