#pragma once

#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/finding.hpp"

namespace loopscope::storage {

/// What is to be said of a connection before it is made, all of it warnings: how it is protected on
/// its way (transport_security.hpp) and where its password comes from (password_sources.hpp). For
/// check-config, and for a program's log when it starts. Throws DatabaseError when the connection
/// string cannot be read.
[[nodiscard]] std::vector<Finding> check_connection(const ConnectionSettings& settings);

}  // namespace loopscope::storage
