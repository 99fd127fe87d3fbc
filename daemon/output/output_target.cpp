#include "daemon/output/output_target.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <string>
#include <sys/stat.h>
#include <utility>

#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

[[noreturn]] void refuse_pipe(const OutputTarget& target, const std::string& why,
                              const std::string& hint) {
  throw Failure(ExitCode::usage,
                fmt::format("cannot write {}: it is a pipe that {}", target.file.string(), why),
                hint);
}

bool is_pipe(const FollowedPath& path) {
  struct stat status {};
  const int links = path.open_file ? 0 : AT_SYMLINK_NOFOLLOW;
  return ::fstatat(path.folder.number(), path.name.c_str(), &status, links) == 0 &&
         S_ISFIFO(status.st_mode);
}

/// What was handed over open may be written to even where it may not be opened by its name: a pipe
/// of whoever has called sudo. Not open for anything else.
Descriptor handed_over(const FollowedPath& path) {
  struct stat folder {};
  struct stat own {};
  const bool is_own = path.open_file && ::fstat(path.folder.number(), &folder) == 0 &&
                      ::stat("/proc/self/fd", &own) == 0 && folder.st_dev == own.st_dev &&
                      folder.st_ino == own.st_ino;
  if (!is_own || ::faccessat(path.folder.number(), path.name.c_str(), W_OK, AT_EACCESS) == 0)
    return {};
  return Descriptor(::fcntl(std::stoi(path.name), F_DUPFD_CLOEXEC, 0));
}

/// Waits for nobody while it opens; what is written afterwards waits for its reader as usual.
Descriptor open_at_once(const OutputTarget& target) {
  const FollowedPath& path = target.path;
  const int links = path.open_file ? 0 : O_NOFOLLOW;
  Descriptor opened(::openat(path.folder.number(), path.name.c_str(),
                             O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK | links));
  const int error = opened.open() ? 0 : errno;
  if (error == ENXIO && is_pipe(path))
    refuse_pipe(target, "nobody reads", "start its reader first, or name a regular file");
  if (error != 0) fail(error);
  const int flags = ::fcntl(opened.number(), F_GETFL);
  if (flags < 0 || ::fcntl(opened.number(), F_SETFL, flags & ~O_NONBLOCK) != 0) fail(errno);
  return opened;
}

bool is_of_another_user(const struct stat& status) {
  return status.st_uid != 0 && status.st_uid != ::geteuid();
}

}  // namespace

OutputTarget find_output_target(const std::filesystem::path& file) {
  OutputTarget target{file, follow(file)};
  if (target.path.open_file) return target;
  struct stat status {};
  const int seen = ::fstatat(target.path.folder.number(), target.path.name.c_str(), &status,
                             AT_SYMLINK_NOFOLLOW);
  target.replaceable = seen == 0 ? S_ISREG(status.st_mode) : errno == ENOENT;
  return target;
}

Descriptor open_in_place(const OutputTarget& target) {
  if (Descriptor handed = handed_over(target.path); handed.open()) return handed;
  Descriptor opened = open_at_once(target);
  struct stat status {};
  if (::fstat(opened.number(), &status) != 0) fail(errno);
  // One that was handed over open is the caller's choice.
  if (S_ISFIFO(status.st_mode) && !target.path.open_file && is_of_another_user(status))
    refuse_pipe(target, fmt::format("another user (number {}) has made", status.st_uid),
                "remove the pipe, or name a regular file");
  if (!S_ISREG(status.st_mode)) return opened;
  // It was none when it was looked at: somebody has put another in its place.
  if (!target.path.open_file) fail(EEXIST);
  if (::ftruncate(opened.number(), 0) != 0) fail(errno);
  return opened;
}

}  // namespace loopscope::daemon
