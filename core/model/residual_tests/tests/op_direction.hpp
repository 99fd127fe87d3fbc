#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// How far a valve with this much play stands behind op, % of op:
///
///     mv = max(op - w/2, min(op + w/2, mv before)),   lag = mv - op within -w/2 to w/2
///
/// It is -w/2 while op goes up, w/2 while it goes down, and on the way from one to the other for w
/// after each reversal: direction and travel since the reversal in one figure, that no noise on op
/// narrower than w disturbs. NaN where op is; the valve stands meanwhile.
[[nodiscard]] std::vector<double> lag_of_play(std::span<const double> op_percent,
                                              double width_percent);

/// "op_direction": does it matter for the residual which way op last went, and how far since it
/// turned? A valve with play or stiction lags behind op by half its band, on the one side or the
/// other, and does not answer just after a reversal. The lag of a valve with play (lag_of_play())
/// of 1/4, 3/4 and 9/4 of op's usual deviation, a basis for hysteresis of any shape (Prandtl,
/// Ishlinskii), at lags of 1 to 12 samples, beyond what op itself explains (score_test.hpp).
/// Nominates valve_stiction and valve_deadband. nullopt when op is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_op_direction(const ResidualContext& context);

}  // namespace loopscope::core::model
