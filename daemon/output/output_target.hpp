#pragma once

#include <filesystem>

#include "daemon/output/descriptor.hpp"

namespace loopscope::daemon {

/// What a name given for output stands for, once its links are followed.
struct OutputTarget {
  std::filesystem::path path;
  bool replaceable = false;  ///< a regular file, or nothing yet: another may get its name
  bool open_file = false;    ///< a link below /proc, to a file that is open in some process
};

/// Follows the links that `file` itself is, as many as Linux would. A link is followed only if this
/// user or root has made it, since whoever may write into a folder may plant one that leads to any
/// file of the writer's. The folders on the way are the caller's to trust. Throws Failure (usage)
/// for a link of somebody else.
[[nodiscard]] OutputTarget find_output_target(const std::filesystem::path& file);

/// Opens what is not replaceable (device, pipe, file without a name), for writing from its start.
/// Throws std::system_error.
[[nodiscard]] Descriptor open_in_place(const OutputTarget& target);

}  // namespace loopscope::daemon
