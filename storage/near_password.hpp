#pragma once

#include <optional>
#include <string>

#include "storage/connection_target.hpp"

namespace loopscope::storage {

/// A part of a connection string, and what a line of the password file has in its place.
struct NearPassword {
  std::string part;  ///< "host", "port" or "dbname"
  std::string other;
};

/// A line of the target's password file that libpq did not take: it fits but for one part, which is
/// perhaps mistyped, in the file or in the connection string, or all of it fits and the file is
/// ignored. nullopt = there is none, or the file cannot be read. Shows no password.
[[nodiscard]] std::optional<NearPassword> find_near_password(const ConnectionTarget& target);

}  // namespace loopscope::storage
