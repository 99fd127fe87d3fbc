#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "op_dynamics": do op's moves 1 to 20 samples ago (fifteen of them) say something of the residual
/// (score_test.hpp)? Then the linear model misses delay or order. Nominates nothing: that is the
/// baseline's to mend. nullopt when op is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_op_dynamics(const ResidualContext& context);

}  // namespace loopscope::core::model
