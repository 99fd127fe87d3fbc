#pragma once

#include <map>
#include <string>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// The options that a connection would be made with, by libpq's own names ("host", "sslmode",
/// "passfile", ...): those of the settings, of a service file, of the environment (PGHOST,
/// PGSSLMODE, ...) and libpq's defaults. What is not set is missing, and so are port and secrets.
/// Connects to nothing. Throws
/// DatabaseError (give_up) when the connection string cannot be read.
[[nodiscard]] std::map<std::string, std::string> effective_options(
    const ConnectionSettings& settings);

}  // namespace loopscope::storage
