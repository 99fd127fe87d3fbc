#pragma once

#include <string>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// Where a connection would go: what the connection string says, completed as libpq does it by a
/// service file, the environment and its defaults. Lists of hosts stay lists.
struct ConnectionTarget {
  std::string host;  ///< name, address or folder of a unix socket; empty = libpq's usual socket
  std::string port;
  std::string database;
  std::string user;
  std::string password_file = {};  ///< where libpq looks for the password; empty = nowhere
};

/// Connects to nothing. Throws DatabaseError (give_up) for a string that libpq cannot read, and for
/// a service that does not exist.
[[nodiscard]] ConnectionTarget connection_target(const ConnectionSettings& settings);

/// Whether the connection string says who logs in: by user=, or by naming a service, whose entry
/// says it. Throws as connection_target().
[[nodiscard]] bool says_user(const ConnectionSettings& settings);

/// The same connection string with another login, in the keyword form. Throws as
/// connection_target().
[[nodiscard]] std::string with_user(const ConnectionSettings& settings, const std::string& user);

}  // namespace loopscope::storage
