#include "daemon/setup/check_databases.hpp"

#include <fmt/format.h>
#include <iostream>
#include <string>
#include <vector>

#include "config/http_address.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/printable.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "storage/historian/setup/check_writer.hpp"
#include "storage/results/schema/check_owner.hpp"

namespace loopscope::daemon {
namespace {

/// Prints the findings about one database; returns how many are problems.
int print_findings(const std::string& about, const std::vector<storage::Finding>& findings) {
  int problems = 0;
  for (const storage::Finding& finding : findings) {
    const char* judgement = !finding.ok ? "PROBLEM" : finding.warning ? "warning" : "ok";
    std::cout << fmt::format("{:<8} {}: {}\n", judgement, printable(about),
                             printable(finding.what));
    if (!finding.ok) ++problems;
    if (!finding.hint.empty()) std::cout << "         HINT: " << printable(finding.hint) << '\n';
  }
  return problems;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += ", " + name;
  return text;
}

/// The pages need no login: whoever reaches the address reads them.
std::vector<storage::Finding> check_http(const config::DaemonSettings& daemon) {
  const auto parsed = config::parse_http_address(daemon.http_address);
  if (!parsed) return {{true, "none", "", false}};
  const storage::Finding names{
      true, "answers to addresses and localhost" + joined(daemon.http_names), "", false};
  if (parsed->loopback)
    return {{true, daemon.http_address + ", for this host alone", "", false}, names};
  return {
      {true,
       daemon.http_address + " is not of the loopback: anyone who reaches it can read the pages",
       "write 127.0.0.1 or [::1] and let a proxy with a login stand before it, or guard the "
       "port by a firewall",
       true},
      names};
}

int check_historians(const config::Settings& settings) {
  int problems = 0;
  for (const config::HistorianSettings& historian : settings.historians) {
    problems += print_findings(
        "historian " + historian.name,
        storage::check_historian(historian_connection(historian), historian_layout(historian)));
    if (historian.writer_connection.empty()) continue;
    problems += print_findings(
        "import into " + historian.name,
        storage::check_writer(historian_writer_connection(historian), historian_layout(historian)));
  }
  return problems;
}

}  // namespace

int check_databases(const config::Settings& settings, storage::SchemaStage stage) {
  print_findings("HTTP", check_http(settings.daemon));
  int problems = print_findings("results database",
                                storage::check_results(results_connection(settings), stage));
  if (!settings.results.owner_connection.empty()) {
    problems +=
        print_findings("results database, owner", storage::check_owner(owner_connection(settings)));
  }
  if (!settings.results.engineer_connection.empty()) {
    problems += print_findings("results database, engineer",
                               storage::check_engineer(engineer_connection(settings), stage));
  }
  return problems + check_historians(settings);
}

}  // namespace loopscope::daemon
