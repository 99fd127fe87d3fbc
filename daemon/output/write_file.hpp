#pragma once

#include <filesystem>
#include <string>

namespace loopscope::daemon {

/// Writes `content` to `file`, links followed.
///
/// A regular file or one that does not exist yet is written whole or not at all: under another
/// name in the same folder first, then renamed; a file that was there keeps its permissions.
/// Anything else (device, pipe) is never replaced but written to directly. Throws Failure (usage)
/// naming the file and the system's reason when that cannot be done.
void write_file(const std::filesystem::path& file, const std::string& content);

}  // namespace loopscope::daemon
