#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace loopscope::daemon {

/// A word of a command line that names no command, or an option that the command does not have.
struct UnknownWord {
  std::string what;  ///< `unknown command "oncee"`, `loopscope once has no option "--confg"`
  std::string hint;  ///< the one of a similar name, or where all of them are listed
};

/// The first such word after a command line was parsed, well or not; nullopt where there is none.
[[nodiscard]] std::optional<UnknownWord> find_unknown_word(const CLI::App& program);

}  // namespace loopscope::daemon
