#pragma once

#include "config/settings.hpp"
#include "storage/results/schema/check_results.hpp"

namespace loopscope::daemon {

/// Tries every connection of the settings with the rights that it is for, looks at address and
/// names of the pages, and prints a line for each thing that was looked at, a problem with its
/// hint; how many problems there are. Changes nothing.
[[nodiscard]] int check_databases(const config::Settings& settings,
                                  storage::SchemaStage stage = storage::SchemaStage::migrated);

}  // namespace loopscope::daemon
