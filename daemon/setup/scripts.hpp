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

/// The command that runs a script of this name.
[[nodiscard]] std::string psql_command(const Script& script,
                                       const storage::ConnectionTarget& target,
                                       const std::string& file);

/// Writes the script into `folder` and says how it is run, or prints it where that is empty; what
/// is printed is SQL from its first line to its last. Throws Failure as write_file() does.
void hand_out(const Script& script, const storage::ConnectionTarget& target,
              const std::string& folder);

}  // namespace loopscope::daemon
