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
#include "daemon/catalogue/select_loops.hpp"
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
  bool all = false;                           ///< every loop of the catalogue
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
  const CsvTable table = read_csv(options.file, is_header_of_catalogue);
  OpenCatalogue opened = open(options);
  const auto entries =
      parse_catalogue(table, defaults_of(opened.settings), opened.catalogue.list());
  require_known_sources(opened, entries);
  const storage::SavedLoops saved = opened.catalogue.save(entries);
  std::cout << fmt::format("{} added, {} changed, {} as before\n",
                           core::text::counted(saved.added, "loop", "loops"), saved.changed,
                           saved.unchanged);
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

/// One tag for several loops is a mistake; none for several is not.
void require_own_tags(const LoopsOptions& options, std::size_t loops) {
  for (const TagRole& role : kTagRoles) {
    const auto given = options.fields.find(std::string(role.name) + "_tag");
    if (loops < 2 || given == options.fields.end() || given->second.empty()) continue;
    throw Failure(
        ExitCode::usage,
        fmt::format("{} for {} loops: each has a tag of its own", option_of(given->first), loops),
        "set tags loop by loop, or with loopscope loops load");
  }
}

std::vector<CatalogueEntry> meant(const LoopsOptions& options,
                                  const std::vector<CatalogueEntry>& all) {
  return options.all ? all : select_loops(all, options.names);
}

void require_names(const LoopsOptions& options) {
  if (options.all || !options.names.empty()) return;
  throw Failure(ExitCode::usage, "no loop is named",
                "name loops or patterns of their names, e.g. 'FIC-*', or say --all");
}

void set_fields(const LoopsOptions& options) {
  require_names(options);
  if (options.fields.empty()) {
    throw Failure(ExitCode::usage, "nothing to set", "see loopscope loops set --help");
  }
  OpenCatalogue opened = open(options);
  const storage::SavedLoops saved =
      opened.catalogue.change([&](const std::vector<CatalogueEntry>& all) {
        std::vector<CatalogueEntry> entries = meant(options, all);
        require_own_tags(options, entries.size());
        for (CatalogueEntry& entry : entries) apply_fields(options, entry);
        require_known_sources(opened, entries);
        return entries;
      });
  std::cout << fmt::format("{} changed, {} as before\n",
                           core::text::counted(saved.changed, "loop", "loops"), saved.unchanged);
}

void switch_loops(const LoopsOptions& options, bool enabled) {
  require_names(options);
  OpenCatalogue opened = open(options);
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : meant(options, opened.catalogue.list()))
    names.push_back(entry.name);
  const std::size_t count = opened.catalogue.set_enabled(names, enabled);
  std::cout << fmt::format("{} {}, {} as before\n", core::text::counted(count, "loop", "loops"),
                           enabled ? "enabled" : "disabled", names.size() - count);
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

void add_selection(CLI::App& command, const SharedLoopsOptions& options) {
  CLI::Option* names =
      command.add_option("NAME", options->names, "Loops by name, or by pattern, e.g. 'FIC-*'");
  command.add_flag("--all", options->all, "Every loop of the catalogue")->excludes(names);
}

}  // namespace

void add_loops(CLI::App& program) {
  CLI::App& loops = *program.add_subcommand(
      "loops", "Lists, adds, changes, disables and deletes loops of the catalogue");
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
  CLI::App& add = add_action(loops, "add", "Adds one loop", options, add_loop);
  add.add_option("NAME", options->names, "Loop")->required()->expected(1);
  add_field_options(add, options);
  CLI::App& set = add_action(loops, "set", "Changes loops, all or none", options, set_fields);
  add_selection(set, options);
  add_field_options(set, options);
  const std::shared_ptr<const std::string> config(options, &options->config);
  add_discover(loops, config);
  add_check(loops, config);
  add_selection(add_action(loops, "enable", "Analyses these loops again", options,
                           [](const LoopsOptions& o) { switch_loops(o, true); }),
                options);
  add_selection(add_action(loops, "disable", "Leaves these loops out from now on", options,
                           [](const LoopsOptions& o) { switch_loops(o, false); }),
                options);
  add_delete(loops, config);
  loops.callback([&loops, options] {
    if (loops.get_subcommands().empty()) list(*options);
  });
}

}  // namespace loopscope::daemon
