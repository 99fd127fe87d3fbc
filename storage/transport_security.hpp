#pragma once

#include <optional>

#include "storage/connection_settings.hpp"
#include "storage/finding.hpp"

namespace loopscope::storage {

/// A warning when a connection leaves this machine without sslmode=verify-full: whoever sits on the
/// way can then read along or pose as the server. nullopt = unix sockets and loopback addresses
/// only, or well protected (Kerberos encryption counts). Of several hosts one that is remote is
/// enough. Looks at service files and the environment as libpq does, and connects to nothing.
/// Throws DatabaseError when the connection string cannot be read.
[[nodiscard]] std::optional<Finding> check_transport(const ConnectionSettings& settings);

}  // namespace loopscope::storage
