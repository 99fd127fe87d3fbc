#pragma once

#include <vector>

#include "storage/check_connection.hpp"
#include "storage/connection_settings.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// Connects as the historian's writer (`import` alone) and looks whether it may insert rows; a
/// table that is not there yet `import` can make. Changes nothing. Never throws for a database
/// problem: that is a finding.
[[nodiscard]] std::vector<Finding> check_writer(const ConnectionSettings& settings,
                                                const SourceLayout& layout);

}  // namespace loopscope::storage
