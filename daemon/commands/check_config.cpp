#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <string>

#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/setup/check_databases.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

void check_config(const std::string& file) {
  const config::Settings settings = config::read_settings(file);
  std::cout << fmt::format("{:<8} {}: no problem in the file\n", "ok", file);
  if (const int problems = check_databases(settings, file).problems; problems > 0) {
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
