#pragma once

#include <cstdint>
#include <vector>

#include "core/model/questions/answer.hpp"
#include "core/model/residual_view.hpp"

namespace loopscope::core::model {

/// What is left after the fit, questioned. The names of the questions, in this order:
/// white, op_dynamics, op_direction, op_level, response_level, time_level, time_gain, time_spread,
/// time_event, periodic, grid, held, nonlinear, ngi. One that cannot be asked (no op, op constant,
/// too many gaps) is left out; empty when fewer than 200 innovations are there or they do not vary.
///
/// Each p is that of its own question; the questions are not corrected for each other. `seed`
/// drives the simulations of core/hos. Throws std::invalid_argument when the spans differ in length
/// or the sample interval is not positive. `known`: of question_residual_first() on the same view,
/// not asked again.
[[nodiscard]] std::vector<Answer> question_residual(const ResidualView& view, std::uint64_t seed,
                                                    const std::vector<Answer>& known = {});

/// All but the last two, which cost more than the others together.
[[nodiscard]] std::vector<Answer> question_residual_quickly(const ResidualView& view);

/// Those that a story starts from: op_direction, op_level, grid, held.
[[nodiscard]] std::vector<Answer> question_residual_first(const ResidualView& view);

}  // namespace loopscope::core::model
