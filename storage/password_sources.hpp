#pragma once

#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/finding.hpp"

namespace loopscope::storage {

/// Warnings about where libpq looks for this connection's password: a password file that it ignores
/// because others may read it or that is not there although it is named, and PGPASSWORD. Empty =
/// nothing to say. Never shows a password. Throws DatabaseError when the connection string cannot
/// be read.
[[nodiscard]] std::vector<Finding> check_password_sources(const ConnectionSettings& settings);

}  // namespace loopscope::storage
