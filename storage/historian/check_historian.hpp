#pragma once

#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/finding.hpp"
#include "storage/historian/narrow_layout.hpp"

namespace loopscope::storage {

/// Connects as the historian's reader and checks relation, columns, types, the right to read, an
/// index that starts with (tag, time), and the newest row. The clock's difference from the results
/// database is left to the caller. Never throws for a database problem: that is a finding.
[[nodiscard]] std::vector<Finding> check_historian(const ConnectionSettings& settings,
                                                   const NarrowLayout& layout);

}  // namespace loopscope::storage
