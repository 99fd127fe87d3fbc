#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace loopscope::daemon {

/// A program and all that it is given.
struct ChildStart {
  std::filesystem::path program;
  std::vector<std::string> arguments;    ///< without its name
  std::vector<std::string> environment;  ///< "NAME=VALUE", nothing else
  std::array<int, 3> streams{};          ///< descriptors that become its 0, 1 and 2; no other
};

/// Starts it in a group of its own, in the folder /, with no signal blocked or ignored. It is
/// killed when the thread that has called this ends, and so when the process ends, however that
/// is killed. Returns its number, which is that of the group, when the program runs. Throws
/// std::system_error when it cannot be started.
[[nodiscard]] pid_t start_child(const ChildStart& start);

}  // namespace loopscope::daemon
