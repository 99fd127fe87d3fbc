#include "daemon/output/followed_path.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <fcntl.h>
#include <fmt/format.h>
#include <iterator>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <utility>
#include <vector>

#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

/// As many links as Linux itself follows.
constexpr int kMostLinks = 40;
constexpr int kFolder = O_PATH | O_DIRECTORY | O_CLOEXEC;

Descriptor opened_or_fail(Descriptor opened) {
  if (!opened.open()) fail(errno);
  return opened;
}

/// Links below /proc lead to open files, which may have no name any more: their text is none.
bool is_in_proc(const Descriptor& link) {
  struct statfs system {};
  return ::fstatfs(link.number(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
}

std::string text_of(const Descriptor& link) {
  std::string text(PATH_MAX, '\0');
  const ssize_t size = ::readlinkat(link.number(), "", text.data(), text.size());
  if (size < 0) fail(errno);
  text.resize(static_cast<std::size_t>(size));
  return text;
}

/// Whether others may rename what lies in the folder, and so put a link of this user's, or of
/// root's, into the place of any name there.
bool others_may_rename_in(const Descriptor& folder) {
  struct stat status {};
  if (::fstat(folder.number(), &status) != 0) fail(errno);
  if (status.st_uid != 0 && status.st_uid != ::geteuid()) return true;
  const bool groups = (status.st_mode & S_IWGRP) != 0 && status.st_gid != ::getegid();
  return (status.st_mode & S_ISVTX) == 0 && (groups || (status.st_mode & S_IWOTH) != 0);
}

class Walk {
 public:
  explicit Walk(const fs::path& path) : path_(path) { go_along(path); }

  FollowedPath to_the_end() {
    for (;;) {
      std::string name = std::move(rest_.back());
      rest_.pop_back();
      const bool last = rest_.empty();
      if (!last && enter(name)) continue;
      const Descriptor link = open_link(name);
      if (!link.open()) {
        if (!last) fail(ENOTDIR);
        return {std::move(folder_), std::move(name)};
      }
      if (!is_in_proc(link)) {
        go_along(text_of(link));
      } else if (last) {
        return {std::move(folder_), std::move(name), true};
      } else {
        folder_ = opened_or_fail(Descriptor(::openat(folder_.number(), name.c_str(), kFolder)));
      }
    }
  }

 private:
  /// Puts the components of `path` before those that are left.
  void go_along(const fs::path& path) {
    if (path.empty()) fail(ENOENT);
    if (path.is_absolute()) {
      folder_ = opened_or_fail(Descriptor(::open("/", kFolder)));
    } else if (!folder_.open()) {
      folder_ = opened_or_fail(Descriptor(::open(".", kFolder)));
    }
    const auto before = static_cast<std::ptrdiff_t>(rest_.size());
    // What a slash at the end leaves empty is the folder itself.
    for (const fs::path& part : path.relative_path()) rest_.push_back(part.empty() ? "." : part);
    if (std::ssize(rest_) == before) rest_.emplace_back(".");
    std::reverse(rest_.begin() + before, rest_.end());
  }

  /// Whether `name` is a folder, and no link to one.
  bool enter(const std::string& name) {
    Descriptor next(::openat(folder_.number(), name.c_str(), kFolder | O_NOFOLLOW));
    if (!next.open() && errno != ENOTDIR) fail(errno);
    if (!next.open()) return false;
    folder_ = std::move(next);
    return true;
  }

  /// The link itself, held open: what is asked of it afterwards is true of the same link, whoever
  /// renames things meanwhile. Not open where there is no link.
  Descriptor open_link(const std::string& name) {
    Descriptor link(::openat(folder_.number(), name.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
    struct stat status {};
    if (!link.open() || ::fstat(link.number(), &status) != 0 || !S_ISLNK(status.st_mode)) return {};
    if (++links_ > kMostLinks) fail(ELOOP);
    // Nobody makes those; where root has no number (user namespaces) they seem to be another's.
    if (is_in_proc(link)) return link;
    if (status.st_uid != 0 && status.st_uid != ::geteuid())
      refuse(name, fmt::format("another user (number {}) has made", status.st_uid));
    if (others_may_rename_in(folder_)) refuse(name, "others may rename in its folder");
    return link;
  }

  [[noreturn]] void refuse(const std::string& link, const std::string& why) const {
    throw Failure(ExitCode::usage,
                  fmt::format("cannot write {}: {} is a link that {}", path_.string(), link, why),
                  "name what the link leads to, or remove the link");
  }

  const fs::path& path_;  ///< as the caller calls it
  Descriptor folder_;
  std::vector<std::string> rest_;  ///< the next component last
  int links_ = 0;
};

}  // namespace

FollowedPath follow(const fs::path& path) {
  return Walk(path).to_the_end();
}

Descriptor open_folder(const fs::path& path) {
  if (path.empty()) fail(ENOENT);
  return follow(path / ".").folder;
}

void make_folders(const fs::path& path) {
  constexpr mode_t kWhatTheMaskLeaves = 0777;
  fs::path begun;
  for (const fs::path& part : path) {
    begun /= part;
    const FollowedPath made = follow(begun);
    if (::mkdirat(made.folder.number(), made.name.c_str(), kWhatTheMaskLeaves) != 0 &&
        errno != EEXIST)
      fail(errno);
  }
}

}  // namespace loopscope::daemon
