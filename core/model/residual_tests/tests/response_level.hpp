#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "response_level": is the process's answer curved? The square of the model's output x about its
/// mean, now and at lags 1 to 5, beyond what x itself at those lags explains (score_test.hpp).
/// Nominates process_nonlinearity.
/// nullopt when x is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_response_level(const ResidualContext& context);

}  // namespace loopscope::core::model
