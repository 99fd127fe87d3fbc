#pragma once

#include <filesystem>
#include <string>

#include "daemon/output/descriptor.hpp"

namespace loopscope::daemon {

/// Where a path ends once its links are followed: a name in a folder that is held open, so that
/// nobody can put another folder into its place.
struct FollowedPath {
  Descriptor folder;
  std::string name;        ///< within the folder; of a link only if open_file
  bool open_file = false;  ///< a link below /proc, to a file that is open in some process
};

/// Goes along `path` component by component. A link, to a folder or to a file, is followed only if
/// this user or root has made it and nobody else may rename it, since whoever may write into a
/// folder may plant one that leads to any file of the writer's; as many links as Linux would
/// follow. A group counts as nobody else if it is this process's own. Throws Failure (usage) for
/// any other link, std::system_error for what the system refuses.
[[nodiscard]] FollowedPath follow(const std::filesystem::path& path);

/// The folder `path` by the same rule, opened with O_PATH.
[[nodiscard]] Descriptor open_folder(const std::filesystem::path& path);

/// Makes the folder `path`, and those above it that are missing, by the same rule.
void make_folders(const std::filesystem::path& path);

}  // namespace loopscope::daemon
