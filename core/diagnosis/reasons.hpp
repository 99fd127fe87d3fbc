#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/diagnosis/odds/cause_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

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
