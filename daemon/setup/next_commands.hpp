#pragma once

#include <string>

#include "storage/check_connection.hpp"
#include "storage/connection_target.hpp"

namespace loopscope::daemon {

/// What comes after `loopscope init`, as README.md, "On your own plant" has it: a command a line.
/// `since`: the day from which on windows of the past are judged.
[[nodiscard]] std::string next_commands(const std::string& settings_file, const std::string& since);

/// What comes before it where a table of the historian at `historian` lacks an index (a finding
/// with its SQL): who makes it, and the command, ready to be copied.
[[nodiscard]] std::string index_command(const storage::Finding& index,
                                        const storage::ConnectionTarget& historian);

}  // namespace loopscope::daemon
