#include "storage/results/schema/migrate.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "config/read_settings.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/service/historians/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

void migrate(const std::string& config_file) {
  const config::Settings settings = config::read_settings(config_file);
  const auto applied = storage::migrate(owner_connection(settings));
  for (const std::string& name : applied) std::cout << "applied " << name << '\n';
  std::cout << "schema loopscope is at version " << storage::required_schema_version() << '\n';
}

}  // namespace

void add_migrate(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("migrate", "Brings the results schema up to date (owner role)");
  const auto config = std::make_shared<std::string>();
  command.add_option("--config", *config, "Settings file")->required();
  command.callback([config] { migrate(*config); });
}

}  // namespace loopscope::daemon
