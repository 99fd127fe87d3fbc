#pragma once

#include <string>

namespace loopscope::daemon {

/// What comes after `loopscope init`, as README.md, "On your own plant" has it: a command a line.
/// `since`: the day from which on windows of the past are judged.
[[nodiscard]] std::string next_commands(const std::string& settings_file, const std::string& since);

}  // namespace loopscope::daemon
