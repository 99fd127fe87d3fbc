#pragma once

#include <string>

namespace loopscope::storage {

/// `name` quoted as an identifier, whatever it holds; for SQL that people run.
[[nodiscard]] std::string quoted_identifier(const std::string& name);

}  // namespace loopscope::storage
