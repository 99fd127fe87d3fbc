#pragma once

#include <vector>

#include "storage/check_connection.hpp"
#include "storage/connection_settings.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// Connects as the historian's reader and checks relations, columns, types, the right to read, the
/// index (one that starts with tag and time, and covers the value), the plan of a window, the
/// window of a tag read by the very statement, and the newest row. The clock's difference from the
/// results database is left to the caller. Never throws for a database problem: that is a finding.
[[nodiscard]] std::vector<Finding> check_historian(const ConnectionSettings& settings,
                                                   const SourceLayout& layout);

}  // namespace loopscope::storage
