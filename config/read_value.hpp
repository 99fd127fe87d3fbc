#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "config/limits.hpp"
#include "config/problem_list.hpp"
#include "config/setting_target.hpp"

namespace loopscope::config {

/// Checks one JSON value against type and limits and stores it in the target; a value that is
/// refused leaves the target alone and becomes a problem at `path`. A number is whole by its value,
/// not by its spelling: 64, 64.0 and 6.4e1 are the same setting.
void read_value(const nlohmann::ordered_json& value, const std::string& path, const Limits& limits,
                const SettingTarget& target, ProblemList& problems);

/// "an object", "a number", ...: what a JSON value is, in a sentence.
[[nodiscard]] std::string kind_of(const nlohmann::ordered_json& value);

}  // namespace loopscope::config
