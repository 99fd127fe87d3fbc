#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>

#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/catalogue/catalogue_csv.hpp"
#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/output/write_csv.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

struct LoopsOptions {
  std::string config;
  std::string file;
  std::vector<std::string> names;
  std::map<std::string, std::string> fields;  ///< field name -> text, as given on the command line
};

using SharedLoopsOptions = std::shared_ptr<LoopsOptions>;

struct OpenCatalogue {
  config::Settings settings;
  storage::Catalogue catalogue;
};

OpenCatalogue open(const LoopsOptions& options) {
  config::Settings settings = config::read_settings(options.config);
  storage::ConnectionSettings connection = owner_connection(settings);
  return {std::move(settings), storage::Catalogue(connection)};
}

/// What a loop has that is added without saying more.
CatalogueEntry defaults_of(const config::Settings& settings) {
  CatalogueEntry entry;
  entry.source = settings.historians.front().name;
  entry.period_s = settings.schedule.default_period_s;
  return entry;
}

void list(const LoopsOptions& options) {
  OpenCatalogue opened = open(options);
  std::cout << fmt::format("{:<28} {:<9} {:<12} {:>9} {:>9} {:>10}  {}\n", "name", "enabled",
                           "type", "interval", "period", "importance", "pv tag");
  for (const CatalogueEntry& entry : opened.catalogue.list()) {
    const std::string interval =
        entry.interval_s ? fmt::format("{:g} s", *entry.interval_s) : std::string("found");
    std::cout << fmt::format(
        "{:<28} {:<9} {:<12} {:>9} {:>7} s {:>10}  {}\n", printable(entry.name),
        entry.enabled ? "yes" : "no", printable(entry.loop_type), interval,
        fmt::format("{:g}", entry.period_s), entry.importance, printable(entry.pv_tag));
  }
}

void export_csv(const LoopsOptions& options) {
  OpenCatalogue opened = open(options);
  write_csv(options.file, catalogue_csv(opened.catalogue.list()));
}

void require_known_sources(const OpenCatalogue& opened,
                           const std::vector<CatalogueEntry>& entries) {
  for (const CatalogueEntry& entry : entries) {
    static_cast<void>(find_historian(opened.settings, entry.source));
  }
}

void load_csv(const LoopsOptions& options) {
  const CsvTable table = read_csv(options.file);
  OpenCatalogue opened = open(options);
  const auto entries =
      parse_catalogue(table, defaults_of(opened.settings), opened.catalogue.list());
  require_known_sources(opened, entries);
  const std::size_t added = opened.catalogue.save(entries);
  std::cout << fmt::format("{} added, {} changed\n", core::text::counted(added, "loop", "loops"),
                           entries.size() - added);
}

std::string option_of(std::string_view field) {
  std::string option = "--" + std::string(field);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

void apply_fields(const LoopsOptions& options, CatalogueEntry& entry) {
  std::string place;
  try {
    for (const auto& [name, text] : options.fields) {
      place = option_of(name);
      find_entry_field(name)->write(entry, text);
    }
    place = fmt::format("loop \"{}\"", entry.name);
    check_entry(entry);
  } catch (const std::invalid_argument& problem) {
    throw Failure(ExitCode::usage, fmt::format("{}: {}", place, problem.what()),
                  "see loopscope loops add --help");
  }
}

void add_loop(const LoopsOptions& options) {
  OpenCatalogue opened = open(options);
  CatalogueEntry entry = defaults_of(opened.settings);
  entry.name = options.names.front();
  if (opened.catalogue.find(entry.name)) {
    throw Failure(ExitCode::usage, fmt::format("loop \"{}\" exists already", entry.name),
                  "change it with loopscope loops set");
  }
  apply_fields(options, entry);
  require_known_sources(opened, {entry});
  opened.catalogue.save(std::vector{entry});
  std::cout << fmt::format("added {}\n", printable(entry.name));
}

Failure no_such_loop(const std::string& name) {
  return {ExitCode::usage, fmt::format("no loop named \"{}\" in the catalogue", name),
          "loopscope loops --config F lists them"};
}

void set_fields(const LoopsOptions& options) {
  OpenCatalogue opened = open(options);
  std::optional<CatalogueEntry> entry = opened.catalogue.find(options.names.front());
  if (!entry) throw no_such_loop(options.names.front());
  apply_fields(options, *entry);
  require_known_sources(opened, {*entry});
  opened.catalogue.save(std::vector{*entry});
  std::cout << fmt::format("changed {}\n", printable(entry->name));
}

void switch_loops(const LoopsOptions& options, bool enabled) {
  OpenCatalogue opened = open(options);
  for (const std::string& name : options.names) {
    if (!opened.catalogue.find(name)) throw no_such_loop(name);
  }
  const std::size_t count = opened.catalogue.set_enabled(options.names, enabled);
  std::cout << fmt::format("{} {}\n", enabled ? "enabled" : "disabled",
                           core::text::counted(count, "loop", "loops"));
}

void add_field_options(CLI::App& command, const SharedLoopsOptions& options) {
  for (const EntryField& field : entry_fields()) {
    if (field.name == "name") continue;
    command.add_option_function<std::string>(
        option_of(field.name),
        [options, name = std::string(field.name)](const std::string& text) {
          options->fields[name] = text;
        },
        std::string(field.description));
  }
}

CLI::App& add_action(CLI::App& loops, const char* name, const char* description,
                     const SharedLoopsOptions& options, void (*carry_out)(const LoopsOptions&)) {
  CLI::App& command = *loops.add_subcommand(name, description);
  command.fallthrough();
  command.callback([options, carry_out] { carry_out(*options); });
  return command;
}

void add_edit_action(CLI::App& loops, const char* name, const char* description,
                     const SharedLoopsOptions& options, void (*carry_out)(const LoopsOptions&)) {
  CLI::App& command = add_action(loops, name, description, options, carry_out);
  command.add_option("NAME", options->names, "Loop")->required()->expected(1);
  add_field_options(command, options);
}

}  // namespace

void add_loops(CLI::App& program) {
  CLI::App& loops =
      *program.add_subcommand("loops", "Lists, adds, changes and disables loops in the catalogue");
  const auto options = std::make_shared<LoopsOptions>();
  loops.add_option("--config", options->config, "Settings file")->required();
  loops.require_subcommand(0, 1);
  add_action(loops, "list", "All loops as a table (default)", options, list);
  add_action(loops, "export", "All loops as CSV", options, export_csv)
      .add_option("FILE", options->file, "File to write, - for standard output")
      ->required();
  add_action(loops, "load", "Adds and changes loops from CSV, all or none", options, load_csv)
      .add_option("FILE", options->file, "File to read")
      ->required();
  add_edit_action(loops, "add", "Adds one loop", options, add_loop);
  add_edit_action(loops, "set", "Changes one loop", options, set_fields);
  const std::shared_ptr<const std::string> config(options, &options->config);
  add_discover(loops, config);
  add_check(loops, config);
  add_action(loops, "enable", "Analyses these loops again", options,
             [](const LoopsOptions& o) { switch_loops(o, true); })
      .add_option("NAME", options->names, "Loops")
      ->required();
  add_action(loops, "disable", "Leaves these loops out from now on", options,
             [](const LoopsOptions& o) { switch_loops(o, false); })
      .add_option("NAME", options->names, "Loops")
      ->required();
  loops.callback([&loops, options] {
    if (loops.get_subcommands().empty()) list(*options);
  });
}

}  // namespace loopscope::daemon
