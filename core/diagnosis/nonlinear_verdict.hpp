#pragma once

#include "core/diagnosis/case.hpp"
#include "core/diagnosis/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The branch of the flow for records whose NGI and NLI pass their limits: oversized valve,
/// sticking valve, a valve that follows, or unexplained. Confidence grows with NGI.
[[nodiscard]] Verdict nonlinear_verdict(const Case& loop);

}  // namespace loopscope::core::diagnosis
