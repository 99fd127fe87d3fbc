#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/setup/column_roles.hpp"

namespace loopscope::daemon {

/// What a table lacks to be read by a preset whose tables are called as a site likes (narrow,
/// loop_row, telegraf, wide), in words: "no column of times"; empty = by its columns it can be.
[[nodiscard]] std::string what_is_missing(const ColumnRoles& roles, std::string_view preset);

/// Column names for a sentence, the first few of many.
[[nodiscard]] std::string listed(std::vector<std::string> names);

}  // namespace loopscope::daemon
