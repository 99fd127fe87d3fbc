#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "grid": do the values of pv lie on a grid (value_grid.hpp) that is coarse beside its fast noise
/// (fast_noise_std())? A step below 0.15 of that is how historians store numbers and no fault: its
/// p is 1. Nominates sensor_quantisation with the step. nullopt when pv is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_grid(const ResidualContext& context);

/// "held": is pv renewed less often than it is recorded? The smallest p, times three, of
/// - a clock: changes of pv fall on every m-th sample only (renewals.hpp);
/// - repeats: more samples repeat the one before than a grid of up to 0.15 of the fast noise makes
///   (not asked where pv lies on a coarser grid, which repeats by itself);
/// - a freeze: the longest run of equal values while op moves, among all runs.
/// Nominates sensor_hold with m, or the mean or longest run. nullopt when pv is missing or
/// constant.
[[nodiscard]] std::optional<TestOutcome> test_held(const ResidualContext& context);

}  // namespace loopscope::core::model
