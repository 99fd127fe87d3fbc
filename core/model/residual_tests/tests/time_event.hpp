#pragma once

#include "core/model/residual_tests/statistics/answer.hpp"
#include "core/model/residual_tests/statistics/questioned.hpp"

namespace loopscope::core::model {

/// "time_event": do a few moments stand out of the noise (outbursts.hpp)? In one-step form a load
/// step is one large innovation, or a cluster that fades. Nominates load_step at each moment.
[[nodiscard]] Answer ask_time_event(const Questioned& questioned);

}  // namespace loopscope::core::model
