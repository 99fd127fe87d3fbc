#include "storage/results/catalogue/maintenance.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include "config/nearest_name.hpp"
#include "config/read_settings.hpp"
#include "daemon/catalogue/maintenance_csv.hpp"
#include "daemon/catalogue/on_behalf_of.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/author_text.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

using storage::MaintenanceEntry;
using storage::MaintenanceLog;
using storage::MaintenanceRefusal;

struct MaintenanceOptions {
  std::string config;
  std::string loop, at, kind;
  std::vector<std::string> words;
  std::string file;
  std::optional<std::string> on_behalf_of;
};

using SharedMaintenanceOptions = std::shared_ptr<MaintenanceOptions>;

/// Where the log of work is, and the zone in which its times are told.
struct OpenedLog {
  explicit OpenedLog(const MaintenanceOptions& options)
      : OpenedLog(config::read_settings(options.config)) {}
  explicit OpenedLog(const config::Settings& settings)
      : results(engineer_connection(settings)), zone(settings.plant.time_zone) {}

  storage::ConnectionSettings results;
  TimeZone zone;
};

std::vector<std::string> loop_names(const storage::ConnectionSettings& results) {
  std::vector<std::string> names;
  for (const storage::CatalogueEntry& entry : storage::Catalogue(results).list())
    names.push_back(entry.name);
  return names;
}

Failure no_such_loop(const std::string& name, const std::vector<std::string>& known) {
  const auto nearest = config::nearest_name(name, known);
  return {ExitCode::usage, fmt::format("no loop named \"{}\" in the catalogue", name),
          (nearest ? fmt::format("did you mean \"{}\"? ", *nearest) : "") +
              "`loopscope loops --config F` lists them"};
}

Failure refusal(const MaintenanceEntry& entry, MaintenanceRefusal reason, const OpenedLog& opened) {
  const std::string work = fmt::format("work on \"{}\" at {}", entry.loop_name,
                                       format_time(entry.done_at_us, opened.zone));
  switch (reason) {
    case MaintenanceRefusal::unknown_loop:
      return no_such_loop(entry.loop_name, loop_names(opened.results));
    case MaintenanceRefusal::in_future:
      return {
          ExitCode::usage, work + " lies in the future of the database's clock",
          "enter work when it is done; a time without an offset is meant in " + opened.zone.name()};
    case MaintenanceRefusal::entered_already:
      break;
  }
  return {ExitCode::usage, work + " is entered already, or given twice, in the same words",
          "`loopscope maintenance --config F list` shows what is entered"};
}

/// In the name that the options say.
void enter(const MaintenanceOptions& options, const OpenedLog& opened,
           std::vector<MaintenanceEntry> entries) {
  const std::optional<std::string> name = on_behalf_of(options.on_behalf_of);
  for (MaintenanceEntry& entry : entries) entry.on_behalf_of = name;
  const auto refused = MaintenanceLog(opened.results).add(entries);
  if (!refused.empty())
    throw refusal(entries.at(refused.front().place), refused.front().reason, opened);
}

void add_work(const MaintenanceOptions& options) {
  const OpenedLog opened(options);
  MaintenanceEntry entry;
  try {
    entry = maintenance_entry(options.loop, options.at, options.kind,
                              fmt::format("{}", fmt::join(options.words, " ")), opened.zone);
  } catch (const std::invalid_argument& problem) {
    throw Failure(ExitCode::usage, problem.what(), "see loopscope maintenance add --help");
  }
  enter(options, opened, {entry});
  std::cout << fmt::format("entered: {} {} {}\n", printable(entry.loop_name),
                           format_time(entry.done_at_us, opened.zone), entry.kind);
}

void load_work(const MaintenanceOptions& options) {
  const OpenedLog opened(options);
  const auto entries =
      parse_maintenance(read_csv(options.file, is_header_of_maintenance), opened.zone);
  enter(options, opened, entries);
  std::cout << fmt::format("{} entered\n", entries.size());
}

void list_work(const MaintenanceOptions& options) {
  const auto& [results, zone] = OpenedLog(options);
  if (!options.loop.empty() && !storage::Catalogue(results).find(options.loop))
    throw no_such_loop(options.loop, loop_names(results));
  MaintenanceLog log(results);
  for (const storage::MaintenanceRow& row :
       log.list(options.loop.empty() ? std::nullopt : std::optional(options.loop))) {
    std::cout << fmt::format(
        "{}  {}  {}  {}: {}\n    {}\n    Entered by {}\n", format_time(row.entry.done_at_us, zone),
        row.word.value_or("-"), printable(row.entry.loop_name), row.entry.kind,
        printable(row.entry.description), printable(with_times_in_zone(row.statement, zone)),
        printable(author_text(row.author, row.entry.on_behalf_of)));
  }
}

CLI::App& add_action(CLI::App& maintenance, const char* name, const char* description,
                     const SharedMaintenanceOptions& options,
                     void (*carry_out)(const MaintenanceOptions&)) {
  CLI::App& command = *maintenance.add_subcommand(name, description);
  command.fallthrough();
  command.callback([options, carry_out] { carry_out(*options); });
  return command;
}

void add_enter(CLI::App& maintenance, const SharedMaintenanceOptions& options) {
  CLI::App& add = add_action(maintenance, "add", "Enters work on one loop", options, add_work);
  add.add_option("--loop", options->loop, "Loop")->required();
  add.add_option(
         "--at", options->at,
         "When it was finished, e.g. 2026-03-01T14:30:00+01:00; without an offset it is meant in "
         "the plant's zone")
      ->required();
  add.add_option("--kind", options->kind, "valve, sensor, tuning, process or other")->required();
  add.add_option("TEXT", options->words, "What was done")->required();
  add.add_option("--on-behalf-of", options->on_behalf_of, kOnBehalfOfHelp);
}

}  // namespace

void add_maintenance(CLI::App& program) {
  CLI::App& maintenance =
      *program.add_subcommand("maintenance", "Enters work on loops and says whether it fixed them");
  const auto options = std::make_shared<MaintenanceOptions>();
  maintenance.add_option("--config", options->config, "Settings file")->required();
  maintenance.require_subcommand(1);
  add_enter(maintenance, options);
  CLI::App& load = add_action(maintenance, "load",
                              "Enters work from CSV (loop,at,kind,description), all or none",
                              options, load_work);
  load.add_option("FILE", options->file, "File to read")->required();
  load.add_option("--on-behalf-of", options->on_behalf_of, kOnBehalfOfHelp);
  add_action(maintenance, "list", "Work, whether it fixed the loop, and why", options, list_work)
      .add_option("--loop", options->loop, "Of this loop only");
}

}  // namespace loopscope::daemon
