#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/diagnosis/odds/cause_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// One step in a sentence: what it is, its figures, the held-out error before and after, p.
[[nodiscard]] std::string step_text(const model::Step& step);

/// What the model leaves, in a sentence.
[[nodiscard]] std::string unexplained_text(const model::Explanation& explanation);

/// How often op is at a limit of its range; empty where that is hardly ever.
[[nodiscard]] std::string output_at_limit_text(const Evidence& evidence);

/// The implied closed loop in a sentence: sensitivity, damping, period, settling time.
[[nodiscard]] std::string closed_loop_text(const model::ClosedLoop& loop);

/// What to do about a verdict, beside what else is probable: tuning waits while a valve or a sensor
/// is to be repaired, which is as probable as `line` (0 to 1) or is the verdict itself.
[[nodiscard]] std::string action_for(VerdictCode code, const Evidence& evidence,
                                     const Causes& causes, double line);

/// A cause with its probability and the parts that weighed most, in words with their numbers.
[[nodiscard]] CauseReport report_of(const WeighedCause& cause);

/// Why this verdict: the parts for and against its cause, strongest first; then what the model, the
/// tests and the oscillation show.
[[nodiscard]] std::vector<std::string> reasons_for(const CauseReport& cause,
                                                   const Evidence& evidence,
                                                   const NonlinearityFinding& nonlinearity);

/// The same without a cause: what was measured alone.
[[nodiscard]] std::vector<std::string> findings(const Evidence& evidence,
                                                const NonlinearityFinding& nonlinearity);

}  // namespace loopscope::core::diagnosis
