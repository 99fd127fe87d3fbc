#pragma once

#include <nlohmann/json.hpp>

#include "daemon/lab/reproduce/reproduction.hpp"

namespace loopscope::daemon {

/// For scripts: {"seeds", "examples": [..], "industrial_cases": [..]}.
[[nodiscard]] nlohmann::ordered_json reproduction_json(const Reproduction& reproduction);

}  // namespace loopscope::daemon
