#pragma once

#include <vector>

#include "storage/check_connection.hpp"
#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// Connects as the schema's owner and says whether `migrate`, `maintain` and `loops` can do their
/// work. A host that has no password for this login runs workers alone, perhaps on purpose: a
/// warning. Changes nothing. Never throws for a database problem: that is a finding.
[[nodiscard]] std::vector<Finding> check_owner(const ConnectionSettings& settings);

}  // namespace loopscope::storage
