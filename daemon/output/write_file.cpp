#include "daemon/output/write_file.hpp"

#include <cerrno>
#include <fmt/format.h>
#include <fstream>
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

std::error_code write_directly(const fs::path& file, const std::string& content) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << content;
  stream.close();
  if (!stream.fail()) return {};
  // A stream need not say why it failed.
  return {errno == 0 ? EIO : errno, std::generic_category()};
}

void keep_permissions(const fs::path& old_file, const fs::path& new_file) {
  std::error_code error;
  const fs::file_status old_status = fs::status(old_file, error);
  if (!fs::is_regular_file(old_status)) return;
  // File systems without permissions refuse: nothing is lost there.
  fs::permissions(new_file, old_status.permissions(), error);
}

std::error_code replace(const fs::path& target, const std::string& content) {
  // The process number keeps two writers apart; the name of the target may have no room for more.
  const fs::path partial = target.parent_path() / fmt::format(".loopscope-{}.partial", getpid());
  std::error_code error = write_directly(partial, content);
  if (!error) {
    keep_permissions(target, partial);
    fs::rename(partial, target, error);
  }
  std::error_code ignored;
  if (error) fs::remove(partial, ignored);
  return error;
}

}  // namespace

void write_file(const fs::path& file, const std::string& content) {
  const std::optional<fs::path> target = replaceable(file);
  const std::error_code error = target ? replace(*target, content) : write_directly(file, content);
  if (error) cannot_write(file, error);
}

}  // namespace loopscope::daemon
