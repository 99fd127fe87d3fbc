#pragma once

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// What a perfect model of the loop would leave, one-step, scaled pv units squared, from the
/// recording alone: the held-out error of the fit's innovations after everything linear that is
/// left in them (their own past, the past moves of op) is taken out too. Never above the fit's own
/// error.
[[nodiscard]] double noise_floor(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
