#pragma once

#include <string>

#include "storage/connection_target.hpp"

namespace loopscope::daemon {

/// SQL that somebody with more rights is to run, by psql.
struct Script {
  std::string server;    ///< "the results server"
  std::string file;      ///< its name where it is kept as a file
  std::string database;  ///< to which psql connects
  std::string sql;
  bool owner_may = false;  ///< the owner of the tables may run it too
};

/// psql as `user` from anywhere, who needs a password mostly, and as the superuser of Debian's
/// packages on the server's own host, who has none. What it runs is still to be added.
[[nodiscard]] std::string psql_as(const std::string& user, const storage::ConnectionTarget& target,
                                  const std::string& database);
[[nodiscard]] std::string psql_on_its_host(const storage::ConnectionTarget& target,
                                           const std::string& database);

/// Writes the script into `folder`, for every login to read, and says how it is run, or prints it
/// where that is empty; what is printed is SQL from its first line to its last. Returns what to
/// call it: the file, or "the SQL above". Throws Failure as write_file() does.
std::string hand_out(const Script& script, const storage::ConnectionTarget& target,
                     const std::string& folder);

}  // namespace loopscope::daemon
