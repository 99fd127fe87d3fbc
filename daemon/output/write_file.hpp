#pragma once

#include <filesystem>
#include <string>

namespace loopscope::daemon {

/// Writes `content` to `file` whole or not at all, as OutputFile does. Throws as it does.
void write_file(const std::filesystem::path& file, const std::string& content);

}  // namespace loopscope::daemon
