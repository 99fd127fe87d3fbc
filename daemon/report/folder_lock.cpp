#include "daemon/report/folder_lock.hpp"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>

#include "daemon/output/followed_path.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = ".loopscope-report.lock";

[[noreturn]] void cannot_lock(const fs::path& folder, int error) {
  throw Failure(ExitCode::usage,
                "cannot write into the folder " + folder.string() + ": " +
                    std::generic_category().message(error),
                error == ELOOP
                    ? "remove the link " + std::string(kName) + " there: no lock is one"
                    : "let the user of the service write there (deploy/RUNBOOK.md, Reports)");
}

/// Workers of several users share a folder that all of them may write into: they may take the lock.
/// Nobody else may open it, since a lock needs no right to write. Only its maker can say so, and
/// only he needs to.
void open_to_writers_of(const Descriptor& folder, const Descriptor& lock) {
  const auto same_user = static_cast<uid_t>(-1);
  struct stat status {};
  if (::fstat(folder.number(), &status) != 0) return;
  mode_t mode = 0600;
  if ((status.st_mode & S_IWOTH) != 0) {
    mode = 0666;
  } else if ((status.st_mode & S_IWGRP) != 0 &&
             ::fchown(lock.number(), same_user, status.st_gid) == 0) {
    mode = 0660;
  }
  ::fchmod(lock.number(), mode);
}

/// O_CREAT only where there is none: with it Linux refuses what is another user's in a sticky
/// folder (fs.protected_regular). Not open, with errno, where neither is possible.
Descriptor open_or_create(const Descriptor& folder) {
  constexpr int kFlags = O_RDWR | O_NOFOLLOW | O_CLOEXEC;
  Descriptor found(::openat(folder.number(), kName, kFlags));
  if (found.open() || errno != ENOENT) return found;
  Descriptor made(::openat(folder.number(), kName, kFlags | O_CREAT | O_EXCL, 0600));
  if (made.open() || errno != EEXIST) return made;
  return Descriptor(::openat(folder.number(), kName, kFlags));
}

Descriptor open_for_lock(const fs::path& folder) {
  try {
    return open_folder(folder);
  } catch (const std::system_error& error) {
    cannot_lock(folder, error.code().value());
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) {
  const Descriptor opened = open_for_lock(folder);
  file_ = open_or_create(opened);
  if (!file_.open()) cannot_lock(folder, errno);
  open_to_writers_of(opened, file_);
  held_ = ::flock(file_.number(), LOCK_EX | LOCK_NB) == 0;
}

}  // namespace loopscope::daemon
