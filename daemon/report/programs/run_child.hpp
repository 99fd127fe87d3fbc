#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// The first executable file of that name in the folders of `search_path` (as the variable PATH);
/// nullopt = none. Empty folders, which would mean the current one, are left out.
[[nodiscard]] std::optional<std::filesystem::path> find_program(std::string_view name,
                                                                std::string_view search_path);

/// A program to run: found by path, no shell between.
struct ChildCommand {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::string_view input;                      ///< its standard input
  std::chrono::milliseconds patience{30'000};  ///< then it is ended, with what it has started
};

/// The name under which a child can open its input.
inline constexpr const char* kInputName = "/proc/self/fd/0";

/// What it left behind.
struct ChildResult {
  int exit_code = -1;  ///< -1 = ended by a signal, or by us
  bool out_of_time = false;
  std::string out;        ///< standard output
  std::string complaint;  ///< the beginning of its standard error
};

/// Runs a program to its end: input as a file in memory (which it can also open by name, as
/// kInputName), output through pipes, an environment of its own
/// (PATH, HOME that does not exist, UTF-8, UTC) in which no variable of ours steers it, no
/// descriptor but these three, the current folder /. It ends at once when `stop` is asked for,
/// when it has written 256 MiB, and with this process, however that is ended. Blocks until then.
/// Throws std::system_error when it cannot be started.
[[nodiscard]] ChildResult run_child(const ChildCommand& command, const std::stop_token& stop = {});

}  // namespace loopscope::daemon
