#pragma once

#include <nlohmann/json_fwd.hpp>

#include "config/problem_list.hpp"
#include "config/settings.hpp"

namespace loopscope::config {

/// Reads a JSON tree by the table of settings: every key is known, every value within its limits,
/// every required one present, or there is a problem. What is not given keeps its default.
[[nodiscard]] Settings read_tree(const nlohmann::ordered_json& root, ProblemList& problems);

}  // namespace loopscope::config
