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
/// real valves keep to no law for a whole record. Three witnesses have to agree: the residual of
/// the linear loop follows op's direction ("op_direction"), and either the simulation error and the
/// shape of the cycle (limit_cycle_cause.hpp) or, where op made a few strokes only, its slow travel
/// (slow_travel.hpp). Errors of the step are simulation errors on blocks held out. Its p is that
/// of the residual's witness, its evidence -2 ln p, and its margin ten times the log odds of the
/// cycle's shape (the units of Step::margin), or the evidence where strokes decide. `op_turns` as
/// in Excitation.
[[nodiscard]] std::optional<Step> find_hysteresis(const ModelInput& input,
                                                  const std::vector<TestOutcome>& answers,
                                                  std::size_t op_turns);

/// Of such a step: whether op's slow travel is the witness, not the cycle.
[[nodiscard]] bool told_by_strokes(const Step& step);

}  // namespace loopscope::core::model
