#include "daemon/output/partial_file.hpp"

#include <cerrno>
#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <random>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <utility>

namespace loopscope::daemon {
namespace {

constexpr std::string_view kBegin = ".loopscope-";
constexpr std::string_view kEnd = ".partial";
constexpr std::size_t kRandomDigits = 16;
constexpr mode_t kOwnersAlone = 0600;
/// Without the bits that let a file run as its owner or group: a folder's owner could have set
/// them.
constexpr mode_t kPermissions = 0777;

void require(bool done) {
  if (!done) fail(errno);
}

/// Nobody can plant anything under a name that cannot be guessed.
std::string random_name() {
  std::random_device device;
  return fmt::format("{}{:08x}{:08x}{}", kBegin, device(), device(), kEnd);
}

bool is_such_name(std::string_view name) {
  return name.size() == kBegin.size() + kRandomDigits + kEnd.size() && name.starts_with(kBegin) &&
         name.ends_with(kEnd) &&
         name.substr(kBegin.size(), kRandomDigits).find_first_not_of("0123456789abcdef") ==
             std::string_view::npos;
}

/// Whether the new file is its writer's: a file that was not locked yet may have been taken for one
/// of a dead writer, which is locked and removed in one go.
bool keep(const Descriptor& file) {
  // A file system without locks has none of the others either.
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
  struct stat status {};
  return ::fstat(file.number(), &status) == 0 && status.st_nlink > 0;
}

Descriptor create(const Descriptor& folder, std::string& name) {
  constexpr int kTries = 10;
  for (int tries = 0; tries < kTries; ++tries) {
    name = random_name();
    Descriptor file(::openat(folder.number(), name.c_str(),
                             O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnersAlone));
    if (file.open() && keep(file)) return file;
    if (!file.open() && errno != EEXIST) fail(errno);
  }
  fail(EEXIST);
}

/// The folder opened for listing and fsync; not open where its user may only write into it.
Descriptor readable(const Descriptor& folder) {
  return Descriptor(::openat(folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

/// A file of this user that no writer holds any more. It stays locked in `file`.
bool is_left_behind(const Descriptor& folder, const char* name, Descriptor& file) {
  file = Descriptor(::openat(folder.number(), name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  return file.open() && ::fstat(file.number(), &status) == 0 && S_ISREG(status.st_mode) &&
         status.st_uid == ::geteuid() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0;
}

struct CloseListing {
  void operator()(DIR* listing) const { ::closedir(listing); }
};

/// As far as it goes: what cannot be removed is in nobody's way.
void remove_left_behind(const Descriptor& folder) {
  Descriptor listed = readable(folder);
  if (!listed.open()) return;
  const std::unique_ptr<DIR, CloseListing> names(::fdopendir(listed.number()));
  if (!names) return;
  static_cast<void>(listed.release());  // closedir() closes it
  while (const dirent* entry = ::readdir(names.get())) {
    Descriptor file;
    if (is_such_name(entry->d_name) && is_left_behind(folder, entry->d_name, file))
      ::unlinkat(folder.number(), entry->d_name, 0);
  }
}

/// What the mask leaves of the usual permissions. umask() itself can only be asked by changing it
/// for every thread.
mode_t mode_of_new_file() {
  constexpr std::string_view kMask = "Umask:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(kMask))
      return 0666U & ~static_cast<mode_t>(std::stoul(line.substr(kMask.size()), nullptr, 8));
  }
  return kOwnersAlone;
}

/// With an access list the bits of the group are the most that anybody in the list has.
bool has_access_list(const Descriptor& folder, const std::string& name) {
  const std::string path = fmt::format("/proc/self/fd/{}/{}", folder.number(), name);
  return ::lgetxattr(path.c_str(), "system.posix_acl_access", nullptr, 0) > 0;
}

/// Whether the new file has the group of the old one; that of one's own is kept if it may be.
bool has_group_of(const struct stat& old, const Descriptor& file) {
  struct stat now {};
  if (::fstat(file.number(), &now) == 0 && now.st_gid == old.st_gid) return true;
  const auto same_user = static_cast<uid_t>(-1);
  return old.st_uid == ::geteuid() && ::fchown(file.number(), same_user, old.st_gid) == 0;
}

/// What the group has no more than everybody has.
mode_t as_for_everybody(mode_t mode) {
  return (mode & ~static_cast<mode_t>(S_IRWXG)) | (mode & (mode << 3U) & S_IRWXG);
}

/// Also gives `file` the group of the old one if it can.
mode_t mode_instead_of(const Descriptor& folder, const std::string& target,
                       const Descriptor& file) {
  struct stat old {};
  if (::fstatat(folder.number(), target.c_str(), &old, AT_SYMLINK_NOFOLLOW) != 0 ||
      !S_ISREG(old.st_mode))
    return mode_of_new_file();
  mode_t kept = old.st_mode & kPermissions;
  if (old.st_uid != ::geteuid()) kept &= mode_of_new_file();
  const bool same_group = has_group_of(old, file) && !has_access_list(folder, target);
  return same_group ? kept : as_for_everybody(kept);
}

void make_name_durable(const Descriptor& folder) {
  const Descriptor synced = readable(folder);
  // EINVAL: a file system that has no such thing.
  if (synced.open()) require(::fsync(synced.number()) == 0 || errno == EINVAL);
}

}  // namespace

PartialFile::PartialFile(FollowedPath target)
    : folder_(std::move(target.folder)), target_(std::move(target.name)) {
  file_ = create(folder_, name_);
  remove_left_behind(folder_);
}

PartialFile::~PartialFile() {
  if (!name_.empty()) ::unlinkat(folder_.number(), name_.c_str(), 0);
}

void PartialFile::replace_target() {
  // File systems without permissions refuse: nothing is lost there.
  ::fchmod(file_.number(), mode_instead_of(folder_, target_, file_));
  require(::fsync(file_.number()) == 0);
  require(::renameat(folder_.number(), name_.c_str(), folder_.number(), target_.c_str()) == 0);
  name_.clear();
  make_name_durable(folder_);
}

}  // namespace loopscope::daemon
