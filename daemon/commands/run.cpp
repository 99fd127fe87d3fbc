#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "daemon/commands/commands.hpp"
#include "daemon/service/service.hpp"

namespace loopscope::daemon {

void add_run(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("run", "The daemon: polls, analyses, writes results until stopped");
  const auto config = std::make_shared<std::string>();
  command.add_option("--config", *config, "Settings file")->required();
  command.callback([config] { run_service(*config); });
}

}  // namespace loopscope::daemon
