#pragma once

#include <cstddef>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// Puts the valve of find_hysteresis() in place of the steps that its slips pass for, and turns the
/// errors of the whole explanation into simulation errors. Other effects stand where the shape of
/// the cycle is not clear beyond doubt and an outside oscillation is among them, or what they leave
/// no longer follows op's direction. A valve among the steps is weighed by the cycle instead
/// (cycle_valve.hpp), unless jumps come first that may be its slips and the shape of the cycle is
/// clear beyond doubt. Where op made a few strokes only nothing of that stands. `first`: asked of
/// the linear loop's residual; `left`: of the last model's.
void apply_limit_cycle_evidence(const ModelInput& input, const std::vector<TestOutcome>& first,
                                const std::vector<TestOutcome>& left, std::size_t op_turns,
                                Explanation& explanation);

}  // namespace loopscope::core::model
