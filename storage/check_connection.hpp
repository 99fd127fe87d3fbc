#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// One thing that check-config found.
struct Finding {
  bool ok = false;
  std::string what;      ///< what was checked, or "what, where" of the problem
  std::string hint;      ///< how to mend it; empty when ok without a warning
  bool warning = false;  ///< ok, but better changed: `hint` says how
  /// Where an index is what is missing: the SQL that makes it, and the owner of the table.
  std::string index_sql = {}, table_owner = {};
};

/// Warnings about where libpq looks for this connection's password: a password file that it ignores
/// because others may read it or that is not there although it is named, a service file with a
/// password that others may read, and PGPASSWORD. Empty = nothing to say. Never shows a password.
/// Throws DatabaseError when the connection string cannot be read.
[[nodiscard]] std::vector<Finding> check_password_sources(const ConnectionSettings& settings);

/// A warning when a connection leaves this machine without sslmode=verify-full: whoever sits on the
/// way can then read along or pose as the server. nullopt = unix sockets and loopback addresses
/// only, or well protected (Kerberos encryption counts). Of several hosts one that is remote is
/// enough. Looks at service files and the environment as libpq does, and connects to nothing.
/// Throws DatabaseError when the connection string cannot be read.
[[nodiscard]] std::optional<Finding> check_transport(const ConnectionSettings& settings);

/// What is to be said of a connection before it is made, all of it warnings: how it is protected on
/// its way and where its password comes from. For check-config, and for a program's log when it
/// starts. Throws DatabaseError when the connection string cannot be read.
[[nodiscard]] std::vector<Finding> check_connection(const ConnectionSettings& settings);

}  // namespace loopscope::storage
