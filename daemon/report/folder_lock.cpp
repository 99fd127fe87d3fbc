#include "daemon/report/folder_lock.hpp"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>

#include "daemon/failure.hpp"
#include "daemon/output/followed_path.hpp"

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

/// Workers of several users share a folder that all of them may write into: the lock is as open as
/// the folder. Only its maker can say so, and only he needs to.
void open_to_writers_of(const Descriptor& folder, const Descriptor& lock) {
  struct stat status {};
  if (::fstat(folder.number(), &status) == 0) ::fchmod(lock.number(), status.st_mode & 0666U);
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
  file_ =
      Descriptor(::openat(opened.number(), kName, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!file_.open()) cannot_lock(folder, errno);
  open_to_writers_of(opened, file_);
  held_ = ::flock(file_.number(), LOCK_EX | LOCK_NB) == 0;
}

}  // namespace loopscope::daemon
