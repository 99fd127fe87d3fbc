#include "storage/password_sources.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
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

bool open_to_others(const fs::file_status& status) {
  const fs::perms others = fs::perms::group_all | fs::perms::others_all;
  return (status.permissions() & others) != fs::perms::none;
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
  if (!open_to_others(status)) return std::nullopt;
  return warning("the password file " + file + " is open to others, so it is ignored",
                 "chmod 0600 " + file);
}

/// A connection does not tell which service it was made by; in the completed string every value is
/// quoted, and a quote within one escaped.
bool asks_for_service(const ConnectionSettings& settings) {
  return std::getenv("PGSERVICE") != nullptr ||
         (" " + complete_conninfo(settings)).find(" service='") != std::string::npos;
}

/// Where libpq looks for services, in its order; the last one is Debian's place for a whole host.
std::vector<fs::path> service_files() {
  std::vector<fs::path> files;
  if (const char* named = std::getenv("PGSERVICEFILE")) {
    files.emplace_back(named);
  } else if (const char* home = std::getenv("HOME")) {
    files.push_back(fs::path(home) / ".pg_service.conf");
  }
  const char* system = std::getenv("PGSYSCONFDIR");
  files.push_back(fs::path(system != nullptr ? system : "/etc/postgresql-common") /
                  "pg_service.conf");
  return files;
}

bool holds_password(const fs::path& file) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.find_first_not_of(" \t"));
    if (line.starts_with("password=") || line.starts_with("sslpassword=")) return true;
  }
  return false;
}

/// libpq takes passwords out of a service file whatever its mode.
std::optional<Finding> check_service_file(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::is_regular_file(status) || !open_to_others(status) || !holds_password(file))
    return std::nullopt;
  return warning("the service file " + file.string() + " holds a password and is open to others",
                 "put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (mode 0600) instead, or"
                 " chmod 0600 " +
                     file.string());
}

}  // namespace

std::vector<Finding> check_password_sources(const ConnectionSettings& settings) {
  std::vector<Finding> findings;
  const auto options = effective_options(settings);
  if (const auto file = options.find(kPassfile); file != options.end()) {
    if (auto finding = check_password_file(settings, file->second)) findings.push_back(*finding);
  }
  if (asks_for_service(settings)) {
    for (const fs::path& file : service_files()) {
      if (auto finding = check_service_file(file)) findings.push_back(*finding);
    }
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
