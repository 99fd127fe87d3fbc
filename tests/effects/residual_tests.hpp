#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "tests/effects/draws.hpp"

namespace loopscope::tests::effects {

/// What the residual tests say of the linear loop fitted to one draw.
[[nodiscard]] std::vector<core::model::TestOutcome> answers_of(const std::string& kind,
                                                               std::uint64_t seed,
                                                               const Plan& plan);

/// A line for each kind of the plan: the share of its draws, %, in which each residual test passes
/// at kNominates. Of kinds without an effect that is the size of the test, else its power.
[[nodiscard]] std::string passing_table(const Plan& plan);

}  // namespace loopscope::tests::effects
