#pragma once

#include <filesystem>

#include "daemon/output/descriptor.hpp"

namespace loopscope::daemon {

/// Held by the one process that writes reports into a folder; the kernel frees it when that one
/// dies. It is a lock on the file `.loopscope-report.lock`, which whoever may write into the folder
/// may take, whatever his user, and nobody else; links to the folder are followed as follow() does.
/// Throws Failure (usage) when there can be no such file.
class FolderLock {
 public:
  /// Does not wait: held() says whether it was free.
  explicit FolderLock(const std::filesystem::path& folder);
  [[nodiscard]] bool held() const { return held_; }

 private:
  Descriptor file_;
  bool held_ = false;
};

}  // namespace loopscope::daemon
