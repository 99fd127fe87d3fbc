#pragma once

#include <vector>

#include "daemon/report/evidence/loop_evidence.hpp"
#include "daemon/report/figures/figure.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// Measured pv beside the model before and after each added effect, over the telling stretch, and
/// what each stage leaves over the whole window, all on one scale; nothing without a model that may
/// claim something.
[[nodiscard]] std::vector<Figure> explanation_figures(const LoopEvidence& evidence,
                                                      const TimeZone& zone);

}  // namespace loopscope::daemon
