#pragma once

#include <optional>
#include <vector>

#include "core/model/explanation.hpp"
#include "core/model/model_input.hpp"
#include "core/model/question_residual.hpp"

namespace loopscope::core::model {

/// A valve that the one-step error cannot show: fast noise hides what it does within a sample, and
/// real valves keep to no law for a whole record. Three witnesses have to agree: the residual of
/// the linear loop follows op's direction ("op_direction"), and either the simulation error and the
/// shape of the cycle (limit_cycle_cause.hpp) or, where op made a few strokes only, its slow travel
/// (slow_travel.hpp). Errors of the step are simulation errors. `op_turns` as in Excitation.
[[nodiscard]] std::optional<Step> find_hysteresis(const ModelInput& input,
                                                  const std::vector<Answer>& answers,
                                                  std::size_t op_turns);

}  // namespace loopscope::core::model
