#pragma once

#include <span>

#include "core/model/selection/stepwise_model.hpp"
#include "core/model/traces.hpp"

namespace loopscope::core::model {

/// The series of a fit as it was judged, no effect named yet. `data`: what was modelled, whatever
/// its rows; `measured`: a value for each of its samples, pv units, NaN = missing.
[[nodiscard]] TraceStage judged_stage(std::span<const double> measured, LoopData data,
                                      const Judged& judged);

}  // namespace loopscope::core::model
