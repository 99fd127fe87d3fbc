#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "op_direction": does it matter for the residual which way op last went, and how far since it
/// turned? A valve with play or stiction lags behind op by half its band, on the one side or the
/// other, and does not answer just after a reversal. The lag of a valve with play (play.hpp) of
/// 1/4, 3/4 and 9/4 of op's usual deviation, a basis for hysteresis of any shape (Prandtl,
/// Ishlinskii), at lags of 1 to 12 samples, beyond what op itself explains (score_test.hpp).
/// Nominates valve_stiction and valve_deadband. nullopt when op is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_op_direction(const ResidualContext& context);

}  // namespace loopscope::core::model
