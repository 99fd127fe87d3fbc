#pragma once

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "time_event": do a few moments stand out of the noise (outbursts.hpp)? In one-step form a load
/// step is one large innovation, or a cluster that fades. Nominates load_step at each moment.
[[nodiscard]] TestOutcome test_time_event(const ResidualContext& context);

}  // namespace loopscope::core::model
