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

}  // namespace

std::string psql_command(const Script& script, const storage::ConnectionTarget& target,
                         const std::string& file) {
  const std::string host = target.host.empty() ? "" : " -h " + shell_word(target.host);
  return fmt::format("psql{} -p {} -U postgres -d {} -f {}", host, shell_word(target.port),
                     shell_word(script.database), shell_word(file));
}

void hand_out(const Script& script, const storage::ConnectionTarget& target,
              const std::string& folder) {
  const std::string file =
      folder.empty() ? script.file : (std::filesystem::path(folder) / script.file).string();
  const std::string command = printable(psql_command(script, target, file));
  const char* owner = script.owner_may ? ", or as the owner of the tables" : "";
  const bool asks = script.sql.find("\\password") != std::string::npos;
  const std::string head =
      fmt::format("-- Loopscope, for {}. As a superuser of it{}{}:\n--   {}\n", script.server,
                  owner, asks ? ", from a file, since psql asks for the passwords" : "", command);
  if (folder.empty()) {
    std::cout << '\n' << head;
    print_lines(script.sql);
    return;
  }
  write_file(file, head + script.sql);
  std::cout << fmt::format("wrote    {}; run it as a superuser of {}{}{}:\n  {}\n", printable(file),
                           script.server, owner, asks ? "; psql asks for the passwords" : "",
                           command);
}

}  // namespace loopscope::daemon
