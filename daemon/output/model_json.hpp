#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/model/results/explanation.hpp"

namespace loopscope::daemon {

/// null for what is unknown or no finite number, which JSON cannot hold.
[[nodiscard]] inline nlohmann::ordered_json number_or_null(std::optional<double> value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value)
                                        : nlohmann::ordered_json(nullptr);
}

/// The object `model` of `analyze --json` (contract.md), stored with every analysis as well. What
/// is unknown, not computed or no finite number is null; without a model every figure is.
[[nodiscard]] nlohmann::ordered_json model_json(
    const std::optional<core::model::Explanation>& explanation);

}  // namespace loopscope::daemon
