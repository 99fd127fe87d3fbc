#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// op that turns more often than this over the record cycles; less, and it makes strokes.
inline constexpr std::size_t kFewStrokes = 8;

/// A valve that the one-step error cannot show: fast noise hides what it does within a sample, and
/// real valves keep to no law for a whole record. Three findings have to agree: the residual of the
/// linear loop follows op's direction ("op_direction"; with a few strokes "op_level" may stand in),
/// and either the simulation error and the shape of the cycle (limit_cycle_cause.hpp) or, where op
/// made a few strokes only, its slow travel (slow_travel.hpp). Errors of the step are simulation
/// errors on blocks held out, pv units squared. Its p is that of the residual test, its evidence -2
/// ln p, and its margin ten times the log odds of the cycle's shape (the units of Step::margin), or
/// the evidence where strokes decide. `op_turns` as in Excitation. nullopt where the findings do
/// not agree, or the valve takes less than 5 % off the error.
[[nodiscard]] std::optional<Step> find_hysteresis(const ModelInput& input,
                                                  const std::vector<TestOutcome>& answers,
                                                  std::size_t op_turns);

/// Of such a step: whether it rests on op's slow travel, not on the cycle.
[[nodiscard]] bool told_by_strokes(const Step& step);

}  // namespace loopscope::core::model
