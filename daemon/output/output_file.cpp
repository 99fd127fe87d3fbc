#include "daemon/output/output_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <system_error>
#include <unistd.h>

#include "daemon/failure.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

/// As many links in a row as Linux itself follows.
constexpr int kMostLinks = 40;

[[noreturn]] void cannot_write(const fs::path& file, const std::error_code& why) {
  throw Failure(ExitCode::usage, fmt::format("cannot write {}: {}", file.string(), why.message()),
                "name a file in a folder that exists, may be written to and has room left");
}

fs::path behind_links(fs::path file) {
  std::error_code error;
  for (int links = 0; links < kMostLinks && fs::is_symlink(file, error); ++links) {
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  return file;
}

/// The file that may be replaced by renaming another onto it; nullopt where `file` has to be
/// written through its own name.
std::optional<fs::path> replaceable(const fs::path& file) {
  std::error_code error;
  const fs::file_type type = fs::status(file, error).type();
  if (type != fs::file_type::regular && type != fs::file_type::not_found) return std::nullopt;
  const fs::path target = behind_links(file);
  // The links below /proc may lead to a file that has no name any more.
  const bool named = type == fs::file_type::not_found || fs::equivalent(file, target, error);
  return named ? std::optional(target) : std::nullopt;
}

void keep_permissions(const fs::path& old_file, const fs::path& new_file) {
  std::error_code error;
  const fs::file_status old_status = fs::status(old_file, error);
  if (!fs::is_regular_file(old_status)) return;
  // File systems without permissions refuse: nothing is lost there.
  fs::permissions(new_file, old_status.permissions(), error);
}

/// Onto the disk before it gets its name: after a loss of power the name must not lead to a file
/// that is empty.
std::error_code make_durable(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {errno, std::generic_category()};
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return {error, std::generic_category()};
}

}  // namespace

OutputFile::OutputFile(const fs::path& file)
    : file_(file), target_(replaceable(file).value_or(fs::path())), written_(file) {
  // The process number keeps two writers apart; the name of the target may have no room for more.
  if (!target_.empty()) {
    written_ = target_.parent_path() / fmt::format(".loopscope-{}.partial", getpid());
  }
  errno = 0;
  stream_.open(written_, std::ios::binary | std::ios::trunc);
  require_good();
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!target_.empty() && !written_.empty()) fs::remove(written_, ignored);
}

void OutputFile::write(std::string_view text) {
  errno = 0;
  stream_ << text;
  require_good();
}

void OutputFile::finish() {
  errno = 0;
  stream_.close();
  require_good();
  if (target_.empty()) return;
  keep_permissions(target_, written_);
  std::error_code error = make_durable(written_);
  if (!error) fs::rename(written_, target_, error);
  if (error) cannot_write(file_, error);
  written_.clear();
}

void OutputFile::require_good() {
  if (!stream_.fail()) return;
  // A stream need not say why it failed.
  cannot_write(file_, {errno == 0 ? EIO : errno, std::generic_category()});
}

}  // namespace loopscope::daemon
