#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/model/results/explanation.hpp"

namespace loopscope::daemon {

/// The object `model` of `analyze --json` (contract.md), stored with every analysis as well. What
/// is unknown, not computed or no finite number is null; without a model every figure is.
[[nodiscard]] nlohmann::ordered_json model_json(
    const std::optional<core::model::Explanation>& explanation);

}  // namespace loopscope::daemon
