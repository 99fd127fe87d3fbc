#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "config/read_settings.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/service/log.hpp"
#include "daemon/service/pass.hpp"
#include "daemon/service/workforce.hpp"

namespace loopscope::daemon {
namespace {

void once(const std::string& config_file) {
  const auto settings =
      std::make_shared<const config::Settings>(config::read_settings(config_file));
  set_up_log(settings->daemon);
  const storage::WriteCount count = run_pass(settings);
  std::cout << count_text(count) << '\n';
}

}  // namespace

void add_once(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("once", "One full pass over all enabled loops, then exits");
  const auto config = std::make_shared<std::string>();
  command.add_option("--config", *config, "Settings file")->required();
  command.callback([config] { once(*config); });
}

}  // namespace loopscope::daemon
