#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "storage/historian/setup/historian_survey.hpp"

namespace loopscope::daemon {

/// A table of the schema public, its columns by name and type.
[[nodiscard]] inline storage::SeenTable seen_table(
    const std::string& name, std::initializer_list<std::pair<std::string, std::string>> columns) {
  storage::SeenTable table{"public", name, "recorder", true, 1000.0, {}};
  for (const auto& [column, type] : columns) table.columns.push_back({column, type, ""});
  return table;
}

}  // namespace loopscope::daemon
