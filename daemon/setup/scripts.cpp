#include "daemon/setup/scripts.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <sstream>

#include "daemon/output/output_file.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/shell_word.hpp"

namespace loopscope::daemon {
namespace {

/// Names are what somebody called his tables.
void print_lines(const std::string& sql) {
  std::istringstream lines(sql);
  for (std::string line; std::getline(lines, line);) std::cout << printable(line) << '\n';
}

/// It holds no secrets, and postgres has to read it: psql asks for passwords.
void write_for_all(const std::string& file, const std::string& content) {
  using std::filesystem::perms;
  write_file(file, content);
  std::error_code ignored;  // somebody else's file: then it is as he wants it
  std::filesystem::permissions(file, perms::group_read | perms::others_read,
                               std::filesystem::perm_options::add, ignored);
}

/// Both commands, a line each that begins with `margin`.
std::string commands(const Script& script, const storage::ConnectionTarget& target,
                     const std::string& file, const std::string& margin) {
  const std::string run = " -f " + shell_word(file);
  return printable(margin + psql_on_its_host(target, script.database) + run) + "\n" +
         printable(margin + psql_as("postgres", target, script.database) + run) + "\n";
}

}  // namespace

std::string psql_as(const std::string& user, const storage::ConnectionTarget& target,
                    const std::string& database) {
  const std::string host = target.host.empty() ? "" : " -h " + shell_word(target.host);
  return fmt::format("psql{} -p {} -U {} -d {}", host, shell_word(target.port), shell_word(user),
                     shell_word(database));
}

std::string psql_on_its_host(const storage::ConnectionTarget& target, const std::string& database) {
  // A server whose sockets lie elsewhere is another one than that of the packages.
  const std::string folder = target.host.starts_with('/') ? " -h " + shell_word(target.host) : "";
  return fmt::format("sudo -u postgres psql{} -p {} -d {}", folder, shell_word(target.port),
                     shell_word(database));
}

std::string hand_out(const Script& script, const storage::ConnectionTarget& target,
                     const std::string& folder) {
  constexpr const char* kWays =
      "on its own host, where postgres can read the file, or over the network with a password";
  std::string file =
      folder.empty() ? script.file : (std::filesystem::path(folder) / script.file).string();
  const char* owner = script.owner_may ? " or as the owner of the tables" : "";
  const char* asks = script.sql.find("\\password") == std::string::npos
                         ? ""
                         : " (from the file: psql asks for the new passwords)";
  const std::string head =
      fmt::format("-- Loopscope, for {}. As a superuser of it{}{},\n-- {}:\n{}", script.server,
                  owner, asks, kWays, commands(script, target, file, "--   "));
  if (folder.empty()) {
    std::cout << '\n' << head;
    print_lines(script.sql);
    return "the SQL above";
  }
  write_for_all(file, head + script.sql);
  std::cout << fmt::format("wrote    {}; run it as a superuser of {}{}{}, {}:\n{}", printable(file),
                           script.server, owner, asks, kWays, commands(script, target, file, ""));
  return file;
}

}  // namespace loopscope::daemon
