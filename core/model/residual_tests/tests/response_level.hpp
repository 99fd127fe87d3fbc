#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/answer.hpp"
#include "core/model/residual_tests/statistics/questioned.hpp"

namespace loopscope::core::model {

/// "response_level": is the process's answer curved? The square of the model's output x about its
/// mean, now and at lags 1 to 5, beyond what x itself at those lags explains (score_test.hpp).
/// Nominates process_nonlinearity.
/// nullopt when x is missing or constant.
[[nodiscard]] std::optional<Answer> ask_response_level(const Questioned& questioned);

}  // namespace loopscope::core::model
