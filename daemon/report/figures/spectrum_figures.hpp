#pragma once

#include <vector>

#include "daemon/report/evidence/loop_evidence.hpp"
#include "daemon/report/figures/figure.hpp"

namespace loopscope::daemon {

/// Power spectrum of the error with its oscillation and two harmonics marked; nothing where the
/// error does not vary.
[[nodiscard]] std::vector<Figure> spectrum_figures(const LoopEvidence& evidence);

/// Squared bicoherence over the principal domain with its peaks numbered; nothing where there is
/// none.
[[nodiscard]] std::vector<Figure> bicoherence_figures(const LoopEvidence& evidence);

}  // namespace loopscope::daemon
