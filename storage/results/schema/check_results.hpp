#pragma once

#include <vector>

#include "storage/check_connection.hpp"
#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// Whether the schema has to be there already, or `migrate` is yet to make it.
enum class SchemaStage { migrated, to_be_made };

/// Connects as the worker and looks up every right it needs and (as a warning) those that it
/// should not have. Never throws for a database problem: that is a finding.
[[nodiscard]] std::vector<Finding> check_results(const ConnectionSettings& settings,
                                                 SchemaStage stage = SchemaStage::migrated);

/// The same of what annotating and the log of work need, as a member of loopscope_engineer.
[[nodiscard]] std::vector<Finding> check_engineer(const ConnectionSettings& settings,
                                                  SchemaStage stage = SchemaStage::migrated);

}  // namespace loopscope::storage
