#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace loopscope::daemon {

/// null for what is unknown or no finite number, which JSON cannot hold.
[[nodiscard]] inline nlohmann::ordered_json number_or_null(std::optional<double> value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value)
                                        : nlohmann::ordered_json(nullptr);
}

}  // namespace loopscope::daemon
