#pragma once

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "time_spread": is the residual larger in one part of the record than in another? The change of
/// the mean of |r| over time (change_point.hpp). It is a property of the noise and nominates
/// nothing, but it warns of errors that compare unlike parts.
[[nodiscard]] TestOutcome test_time_spread(const ResidualContext& context);

}  // namespace loopscope::core::model
