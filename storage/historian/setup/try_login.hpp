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
  State state = State::works;
  std::string problem;  ///< "what, where"; empty where it works
  std::string hint;
};

/// Connects once and ends the session; any PostgreSQL database, not only a historian's. Throws
/// DatabaseError when the connection string cannot be read.
[[nodiscard]] LoginTrial try_login(const ConnectionSettings& settings);

}  // namespace loopscope::storage
