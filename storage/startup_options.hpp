#pragma once

#include <map>
#include <string>

namespace loopscope::storage {

/// Settings of a session: the value of each, by its name in lower case.
using SessionSettings = std::map<std::string, std::string>;

/// The `options` of a connection string, taken apart as the server would.
struct StartupOptions {
  SessionSettings settings;  ///< of `-c NAME=VALUE` and `--NAME=VALUE`, the last of equal names
  std::string rest;          ///< whatever else stands there, as it was
};

/// Never throws: what it cannot read as a setting goes to `rest`.
[[nodiscard]] StartupOptions split_startup_options(const std::string& options);

}  // namespace loopscope::storage
