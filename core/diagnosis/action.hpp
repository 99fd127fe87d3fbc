#pragma once

#include <string>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/odds/cause_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// What to do about a verdict, beside what else is probable: tuning waits while a valve or a sensor
/// is to be repaired, which is as probable as `line` or is the verdict itself.
[[nodiscard]] std::string action_for(VerdictCode code, const Evidence& evidence,
                                     const Causes& causes, double line);

}  // namespace loopscope::core::diagnosis
