#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "grid": do the values of pv lie on a grid (value_grid.hpp) that is coarse beside its fast noise
/// (fast_noise.hpp)? A step below 0.15 of that is how historians store numbers and no fault: p = 1.
/// Nominates sensor_quantisation with the step. nullopt when pv is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_grid(const ResidualContext& context);

}  // namespace loopscope::core::model
