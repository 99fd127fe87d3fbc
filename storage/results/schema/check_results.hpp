#pragma once

#include <vector>

#include "storage/check_connection.hpp"
#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// Connects as the worker and looks up every right it needs and (as a warning) those that it
/// should not have. Never throws for a database problem: that is a finding.
[[nodiscard]] std::vector<Finding> check_results(const ConnectionSettings& settings);

}  // namespace loopscope::storage
