#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "config/http_address.hpp"
#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "storage/check_connection.hpp"
#include "storage/historian/check_historian.hpp"
#include "storage/results/schema/check_results.hpp"

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

void check_config(const std::string& file) {
  const config::Settings settings = config::read_settings(file);
  std::cout << fmt::format("{:<8} {}: no problem in the file\n", "ok", file);
  print_findings("HTTP", check_http(settings.daemon));
  int problems =
      print_findings("results database", storage::check_results(results_connection(settings)));
  for (const config::HistorianSettings& historian : settings.historians) {
    problems += print_findings(
        "historian " + historian.name,
        storage::check_historian(historian_connection(historian), historian_layout(historian)));
  }
  if (problems > 0) {
    throw Failure(ExitCode::database,
                  core::text::counted(problems, "problem", "problems") + " with the databases",
                  "each PROBLEM above has its own hint");
  }
}

}  // namespace

void add_check_config(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "check-config", "Reports every problem of a settings file, connects, checks privileges");
  struct Options {
    std::string config;
    bool describe = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::Option* config = command.add_option("--config", options->config, "Settings file");
  command.add_flag("--describe", options->describe, "Print every setting with its range and unit")
      ->excludes(config);
  command.callback([options] {
    if (options->describe) {
      std::cout << config::describe_settings();
    } else if (options->config.empty()) {
      throw Failure(ExitCode::usage, "--config is required", "or --describe for every setting");
    } else {
      check_config(options->config);
    }
  });
}

}  // namespace loopscope::daemon
