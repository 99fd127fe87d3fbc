#include "storage/password_sources.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "storage/effective_options.hpp"

namespace loopscope::storage {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPassfile = "passfile";

Finding warning(const std::string& what, const std::string& hint) {
  return {true, what, hint, true};
}

/// libpq says nothing when a file is missing, which is right for the usual place alone.
bool is_named(const ConnectionSettings& settings, const std::string& file) {
  ConnectionSettings bare = settings;
  bare.conninfo.clear();
  const auto usual = effective_options(bare);
  const auto found = usual.find(kPassfile);
  return std::getenv("PGPASSFILE") != nullptr || found == usual.end() || found->second != file;
}

std::optional<Finding> check_password_file(const ConnectionSettings& settings,
                                           const std::string& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    if (!is_named(settings, file)) return std::nullopt;
    return warning("the password file " + file + " does not exist or cannot be reached",
                   "check passfile= and PGPASSFILE");
  }
  if (!fs::is_regular_file(status)) {
    return warning("the password file " + file + " is no plain file, so it is ignored",
                   "name a file");
  }
  const fs::perms others = fs::perms::group_all | fs::perms::others_all;
  if ((status.permissions() & others) == fs::perms::none) return std::nullopt;
  return warning("the password file " + file + " is open to others, so it is ignored",
                 "chmod 0600 " + file);
}

}  // namespace

std::vector<Finding> check_password_sources(const ConnectionSettings& settings) {
  std::vector<Finding> findings;
  const auto options = effective_options(settings);
  if (const auto file = options.find(kPassfile); file != options.end()) {
    if (auto finding = check_password_file(settings, file->second)) findings.push_back(*finding);
  }
  if (std::getenv("PGPASSWORD") != nullptr) {
    findings.push_back(warning(
        "PGPASSWORD is set: a password in the environment is passed on to every child, shown by "
        "systemctl, and used for every database",
        "unset it and put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (mode 0600)"));
  }
  return findings;
}

}  // namespace loopscope::storage
