#pragma once

#include <filesystem>

#include "daemon/output/descriptor.hpp"
#include "daemon/output/followed_path.hpp"

namespace loopscope::daemon {

/// What a name given for output stands for, once its links are followed.
struct OutputTarget {
  std::filesystem::path file;  ///< as the caller calls it
  FollowedPath path;
  bool replaceable = false;  ///< a regular file, or nothing yet: another may get its name
};

/// Follows `file` as follow() does, and throws as that does.
[[nodiscard]] OutputTarget find_output_target(const std::filesystem::path& file);

/// Opens what is not replaceable (device, pipe, file without a name), for writing from its start;
/// of an open file of this process that it may not open again, where it stands. Never waits: a pipe
/// that nobody reads is refused, and so is one that another user has put there. Throws Failure
/// (usage) for these, else std::system_error.
[[nodiscard]] Descriptor open_in_place(const OutputTarget& target);

}  // namespace loopscope::daemon
