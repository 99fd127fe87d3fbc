#pragma once

#include <string>

#include "daemon/setup/layout_candidate.hpp"
#include "daemon/setup/questions.hpp"

namespace loopscope::daemon {

/// What `loopscope init` is told; empty = to be asked for, or to be found.
struct SiteOptions {
  std::string results, owner, historian;  ///< connection strings
  std::string name = "plant";             ///< of the historian
  std::string out = "loopscope.json";     ///< settings file
  std::string sql_folder;                 ///< for the SQL; empty = standard output
  std::string time_zone;                  ///< of times without one
  LayoutWishes layout;
  bool force = false;  ///< whether a file that is there may be replaced
};

/// From two servers to settings that work, in as many runs as it takes: tries the logins, hands out
/// the SQL that a server still needs, recognises the historian's tables, writes the settings file
/// whole or not at all, checks it, and says the next commands. Throws Failure and DatabaseError;
/// (database) while something is to be run on a server first.
void set_up_site(SiteOptions options, Questions& questions);

}  // namespace loopscope::daemon
