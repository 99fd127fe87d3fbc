#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "time_gain": does the process answer more, or less, from some time on? The change of
/// sum r(k) x(k) over time (change_point.hpp), x the model's output about its mean; and the same
/// with x(k) - x(k-1), which is what a gain error leaves when the noise wanders. The two are
/// combined (hos/combine_p.hpp). Nominates gain_change with its place and a rough ratio.
/// nullopt when x is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_time_gain(const ResidualContext& context);

}  // namespace loopscope::core::model
