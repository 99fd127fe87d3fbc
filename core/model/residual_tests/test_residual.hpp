#pragma once

#include <vector>

#include "core/model/residual_tests/statistics/residual_view.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// What is left after the fit, put to the residual tests, in this order: white, op_dynamics,
/// op_direction, op_level, response_level, time_gain, time_spread, time_event, periodic, grid,
/// held. One that cannot be made (no op, op constant, too many gaps) is left out; empty when fewer
/// than 200 innovations are there or they do not vary.
///
/// Each p is that of its own test; the tests are not corrected for each other. Throws
/// std::invalid_argument when the spans differ in length or the sample interval is not positive.
[[nodiscard]] std::vector<TestOutcome> test_residual(const ResidualView& view);

}  // namespace loopscope::core::model
