#pragma once

#include <string>

#include "daemon/output/descriptor.hpp"
#include "daemon/output/followed_path.hpp"

namespace loopscope::daemon {

/// A file that becomes another one when it is complete: `.loopscope-RANDOM.partial` in the same
/// folder until then, readable by its writer alone. It never follows a link and never opens what is
/// there already.
///
/// Its writer holds a lock on it (flock). A file of such a name that belongs to this user and that
/// nobody holds was left by a writer that died; the next one in the folder removes it. Every
/// function throws std::system_error with the system's reason.
class PartialFile {
 public:
  explicit PartialFile(FollowedPath target);
  /// Without replace_target() nothing is left behind.
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  [[nodiscard]] int descriptor() const { return file_.number(); }

  /// Gives it the permissions and the name of the target, once it is on the disk: after a loss of
  /// power the name leads to the old file or to all of the new one. Permissions and group are
  /// those of a target of this user's; of another's there is what the mask leaves of them. A group
  /// that is another one than before gets no more than everybody. Access lists are not kept.
  void replace_target();

 private:
  Descriptor folder_;
  std::string target_;  ///< within the folder
  std::string name_;    ///< within the folder; empty = it has become the target
  Descriptor file_;
};

}  // namespace loopscope::daemon
