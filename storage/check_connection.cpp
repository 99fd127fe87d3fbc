#include "storage/check_connection.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <libpq-fe.h>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace loopscope::storage {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPassfile = "passfile";

using Options = std::map<std::string, std::string>;

/// The options that a connection would be made with, by libpq's own names ("host", "sslmode",
/// "passfile", ...): those of the settings, of a service file, of the environment (PGHOST,
/// PGSSLMODE, ...) and libpq's defaults. What is not set is missing, and so are port and secrets.
/// Connects to nothing. Throws DatabaseError (give_up) when the connection string cannot be read.
Options effective_options(const ConnectionSettings& settings) {
  // Only a connection knows what its service file says. This one ends before a name is looked up,
  // because no server has port 0, and with a password at hand libpq looks for none.
  const std::string conninfo = complete_conninfo(settings) + " port='0' password='-'";
  const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectStart(conninfo.c_str()),
                                                                &PQfinish);
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> found(
      PQconninfo(connection.get()), &PQconninfoFree);
  Options options;
  for (const PQconninfoOption* option = found.get(); option && option->keyword; ++option) {
    if (option->val != nullptr && *option->val != '\0') options[option->keyword] = option->val;
  }
  for (const char* ours : {"port", "password", "sslpassword"}) options.erase(ours);
  return options;
}

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
    return warning("the password file " + file + " is not a plain file, so it is ignored",
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

std::string value_of(const Options& options, const std::string& key) {
  const auto found = options.find(key);
  return found == options.end() ? std::string() : found->second;
}

/// The parts of a list of hosts; libpq takes empty ones for "as usual".
std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream rest(list);
  for (std::string part; std::getline(rest, part, ',');) parts.push_back(part);
  return parts;
}

bool is_loopback_address(const std::string& host) {
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24U) == 127U;
  in6_addr v6{};
  if (inet_pton(AF_INET6, host.c_str(), &v6) != 1) return false;
  if (IN6_IS_ADDR_V4MAPPED(&v6)) return v6.s6_addr[12] == 127U;
  return IN6_IS_ADDR_LOOPBACK(&v6);
}

/// Unix sockets, loopback addresses, and the one name that stands for them.
bool is_local(const std::string& host) {
  return host.empty() || host.front() == '/' || host.front() == '@' || host == "localhost" ||
         is_loopback_address(host);
}

/// The first host that is not on this machine; empty = none. An address goes before the name.
std::string remote_host(const Options& options) {
  const std::vector<std::string> names = parts_of(value_of(options, "host"));
  const std::vector<std::string> addresses = parts_of(value_of(options, "hostaddr"));
  for (std::size_t k = 0; k < std::max(names.size(), addresses.size()); ++k) {
    const bool has_address = k < addresses.size() && !addresses[k].empty();
    std::string host = has_address ? addresses[k] : k < names.size() ? names[k] : "";
    if (!is_local(host)) return host;
  }
  return {};
}

/// What somebody on the way to the server can do; empty = nothing.
std::string danger_of(const std::string& sslmode) {
  if (sslmode == "verify-full") return {};
  if (sslmode == "verify-ca") {
    return "whoever has a certificate of the same authority can pose as the server";
  }
  if (sslmode == "require") return "anybody on the way can pose as the server";
  return "anybody on the way can read along or pose as the server";
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
        "PGPASSWORD is set: a password in the environment is passed on to every child process, "
        "shown by systemctl, and used for every database",
        "unset it and put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (mode 0600)"));
  }
  return findings;
}

std::optional<Finding> check_transport(const ConnectionSettings& settings) {
  const Options options = effective_options(settings);
  const std::string host = remote_host(options), sslmode = value_of(options, "sslmode");
  const std::string danger = danger_of(sslmode);
  if (host.empty() || danger.empty() || value_of(options, "gssencmode") == "require") {
    return std::nullopt;
  }
  return Finding{true,
                 "the connection to the remote host " + host + " has sslmode=" + sslmode + ": " +
                     danger + ", " + describe_target(settings),
                 "add sslmode=verify-full and sslrootcert=FILE, the certificate of the authority "
                 "that signed the server's, to the connection string or its service",
                 true};
}

std::vector<Finding> check_connection(const ConnectionSettings& settings) {
  std::vector<Finding> findings = check_password_sources(settings);
  if (auto transport = check_transport(settings)) findings.push_back(*std::move(transport));
  return findings;
}

}  // namespace loopscope::storage
