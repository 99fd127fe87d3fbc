#include "daemon/output/output_target.hpp"

#include <cerrno>
#include <climits>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <system_error>

#include "daemon/failure.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

/// As many links in a row as Linux itself follows.
constexpr int kMostLinks = 40;

/// The link itself, held open: what is asked of it afterwards is true of the same link, whoever
/// renames things meanwhile. Not open where there is no link.
Descriptor open_link(const fs::path& path) {
  Descriptor link(::open(path.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  if (!link.open() || ::fstat(link.number(), &status) != 0 || !S_ISLNK(status.st_mode)) return {};
  if (status.st_uid != 0 && status.st_uid != ::geteuid()) {
    throw Failure(
        ExitCode::usage,
        fmt::format("cannot write {}: {} is a link that another user (number {}) has made",
                    path.string(), path.filename().string(), status.st_uid),
        "name the file that the link leads to, or remove the link");
  }
  return link;
}

/// Links below /proc lead to open files, which may have no name any more: their text is none.
bool is_in_proc(const Descriptor& link) {
  struct statfs system {};
  return ::fstatfs(link.number(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
}

std::string text_of(const Descriptor& link) {
  std::string text(PATH_MAX, '\0');
  const ssize_t size = ::readlinkat(link.number(), "", text.data(), text.size());
  if (size < 0) throw std::system_error(errno, std::generic_category());
  text.resize(static_cast<std::size_t>(size));
  return text;
}

}  // namespace

OutputTarget find_output_target(const fs::path& file) {
  fs::path path = file;
  for (int links = 0; links < kMostLinks; ++links) {
    const Descriptor link = open_link(path);
    if (!link.open()) break;
    if (is_in_proc(link)) return {path, false, true};
    path = path.parent_path() / text_of(link);
  }
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path, error).type();
  return {path, type == fs::file_type::regular || type == fs::file_type::not_found, false};
}

Descriptor open_in_place(const OutputTarget& target) {
  const int links = target.open_file ? 0 : O_NOFOLLOW;
  Descriptor opened(::open(target.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | links));
  struct stat status {};
  if (!opened.open() || ::fstat(opened.number(), &status) != 0)
    throw std::system_error(errno, std::generic_category());
  if (!S_ISREG(status.st_mode)) return opened;
  // It was none when it was looked at: somebody has put another in its place.
  if (!target.open_file) throw std::system_error(std::make_error_code(std::errc::file_exists));
  if (::ftruncate(opened.number(), 0) != 0) throw std::system_error(errno, std::generic_category());
  return opened;
}

}  // namespace loopscope::daemon
