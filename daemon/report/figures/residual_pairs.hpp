#pragma once

#include <cstddef>
#include <vector>

#include "daemon/report/evidence/loop_evidence.hpp"
#include "daemon/report/figures/figure.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// What the model leaves without an effect and with it.
struct ResidualPair {
  std::size_t step = 0;  ///< of the explanation, 0 = the first
  Figure before;
  Figure after;
};

/// Small figures of one scale a pair, over the stretch in which the effect lowers the error most.
/// Residuals of the prediction one sample ahead; where a stage has none, measured less simulated.
/// A step of whose stages neither can be had has no pair.
[[nodiscard]] std::vector<ResidualPair> residual_pairs(const LoopEvidence& evidence,
                                                       const TimeZone& zone);

}  // namespace loopscope::daemon
