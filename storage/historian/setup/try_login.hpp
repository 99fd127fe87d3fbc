#pragma once

#include <string>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// Whether somebody can log in.
struct LoginTrial {
  enum class State {
    works,
    refused,      ///< the server answered: no such database, login or password, no right to connect
    unreachable,  ///< nobody answered
  };
  /// What the server has refused, as far as its words tell (of a server that speaks English).
  enum class Refusal {
    other,  ///< `problem` and `hint` say it
    no_password,
    password_or_login,  ///< a wrong password, or no such login: servers do not tell which
    no_login,
    no_right,     ///< the login is there, but may not use the database
    no_database,  ///< the password, if any was asked for, is right
  };
  State state = State::works;
  std::string problem = {};  ///< "what, where"; empty where it works
  std::string hint = {};
  Refusal refusal = Refusal::other;  ///< where state is refused
};

/// Connects once and ends the session; any PostgreSQL database, not only a historian's. Throws
/// DatabaseError when the connection string cannot be read.
[[nodiscard]] LoginTrial try_login(const ConnectionSettings& settings);

/// Whether the server has a login of this name, asked over a connection that works. Throws
/// DatabaseError.
[[nodiscard]] bool login_exists(const ConnectionSettings& settings, const std::string& user);

}  // namespace loopscope::storage
