#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"
#include "storage/results/schema/check_results.hpp"

namespace loopscope::daemon {

struct DatabaseCheck {
  int problems = 0;
  std::vector<storage::Finding> indexes;  ///< that are missing: reading is slow, but works
};

/// Tries every connection of the settings with the rights that it is for, looks at address and
/// names of the pages, and prints a line for each thing that was looked at, a problem with its
/// hint, whose commands name the settings file. Changes nothing.
[[nodiscard]] DatabaseCheck check_databases(
    const config::Settings& settings, const std::string& settings_file,
    storage::SchemaStage stage = storage::SchemaStage::migrated);

}  // namespace loopscope::daemon
