#include "storage/results/migrate.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "config/read_settings.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/service/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

void print_all(const char* what, const std::vector<std::string>& names) {
  for (const std::string& name : names) std::cout << what << ' ' << name << '\n';
}

void migrate(const std::string& config_file) {
  const config::Settings settings = config::read_settings(config_file);
  const auto applied = storage::migrate(owner_connection(settings));
  print_all("applied", applied);
  std::cout << "schema loopscope is at version " << storage::required_schema_version() << '\n';
}

void maintain(const std::string& config_file) {
  const config::Settings settings = config::read_settings(config_file);
  const auto result =
      storage::maintain(owner_connection(settings), settings.results.retention_months);
  print_all("created", result.created);
  print_all("dropped", result.dropped);
}

void add_config_command(CLI::App& program, const char* name, const char* description,
                        void (*carry_out)(const std::string&)) {
  CLI::App& command = *program.add_subcommand(name, description);
  const auto config = std::make_shared<std::string>();
  command.add_option("--config", *config, "Settings file")->required();
  command.callback([config, carry_out] { carry_out(*config); });
}

}  // namespace

void add_migrate(CLI::App& program) {
  add_config_command(program, "migrate", "Brings the results schema up to date (owner role)",
                     migrate);
}

void add_maintain(CLI::App& program) {
  add_config_command(program, "maintain",
                     "Makes partitions ahead and drops old ones (owner role, by timer)", maintain);
}

}  // namespace loopscope::daemon
