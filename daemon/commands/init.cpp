#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include "config/historian_presets.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/setup/set_up_site.hpp"

namespace loopscope::daemon {
namespace {

void add_layout_options(CLI::App& command, LayoutWishes& layout) {
  const auto names = config::preset_names();
  command
      .add_option("--preset", layout.preset,
                  "Vendor of the historian's tables (default: looked for)")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
  command.add_option("--table", layout.table,
                     "[schema.]table of the historian (default: looked for)");
  command.add_option("--tag-column", layout.tag_column, "Its column of tags, or of loops");
  command.add_option("--time-column", layout.time_column, "Its column of times");
  command.add_option("--value-column", layout.value_column, "Its column of values");
  command.add_option("--quality-column", layout.quality_column, "Its column of quality codes");
}

}  // namespace

void add_init(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "init", "Looks at the servers, prints the SQL for each, writes the settings, checks them");
  const auto options = std::make_shared<SiteOptions>();
  command.add_option("--results", options->results,
                     "Results database: libpq connection string or service=NAME, without password; "
                     "user= is the worker's login (default: loopscope_worker_1)");
  command.add_option("--historian", options->historian,
                     "Historian: the same; user= is a login that reads it (default: "
                     "loopscope_historian_1)");
  command.add_option("--owner", options->owner,
                     "Results database as the schema's owner (default: --results as "
                     "loopscope_owner_1)");
  command.add_option("--name", options->name, "Name of the historian")->capture_default_str();
  command.add_option("--out", options->out, "Settings file to write")->capture_default_str();
  command.add_option("--sql", options->sql_folder,
                     "Folder for results.sql and historian.sql (default: standard output)");
  add_layout_options(command, options->layout);
  command.add_option("--time-zone", options->time_zone,
                     "Zone of times that are stored without one and are not UTC");
  command.add_flag("--force", options->force, "Replace a settings file that is there");
  command.callback([options] {
    Questions questions(std::cin, std::cout, isatty(STDIN_FILENO) == 1);
    set_up_site(*options, questions);
  });
}

}  // namespace loopscope::daemon
