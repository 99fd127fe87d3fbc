#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "config/read_settings.hpp"
#include "core/signal/base_interval.hpp"
#include "core/signal/microseconds.hpp"
#include "core/text/counted.hpp"
#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/commands/option_values.hpp"
#include "daemon/commands/recording_options.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/windows/slot.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/read_time.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/historian/historian_writer.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::LoopRows;
using storage::CatalogueEntry;

struct ImportOptions {
  std::string config;
  std::string loop;
  RecordingOptions recording;
  std::string source;
  std::string type;
  std::string op_range;
  std::string end;
  double period_s = 0.0;
  bool create_table = false;
  bool replace = false;
};

/// ".PV" for pv: what follows the loop's name in a tag that import makes.
std::string suffix_of(const TagRole& role) {
  std::string suffix = "." + std::string(role.name);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return suffix;
}

/// The catalogue's entry brought up to what the command line says; a new one gets tags NAME.PV and
/// so on for the columns that the file has.
CatalogueEntry entry_for(const ImportOptions& options, const config::Settings& settings,
                         const Recording& recording, const std::optional<CatalogueEntry>& known) {
  CatalogueEntry entry = known.value_or(CatalogueEntry{});
  if (!known) {
    entry.name = options.loop;
    entry.source = settings.historians.front().name;
    entry.period_s = settings.schedule.default_period_s;
    const double interval_s = core::signal::base_interval_s(recording.rows.pv);
    if (interval_s > 0.0) entry.interval_s = interval_s;
  }
  for (const TagRole& role : kTagRoles) {
    const bool recorded = !(recording.rows.*role.rows).empty();
    if (recorded && (entry.*role.tag).empty()) entry.*role.tag = entry.name + suffix_of(role);
  }
  if (!options.source.empty()) entry.source = options.source;
  if (!options.type.empty()) entry.loop_type = options.type;
  if (options.period_s > 0.0) entry.period_s = options.period_s;
  if (const auto range = parse_op_range(options.op_range)) entry.op_range = range;
  return entry;
}

/// Where a recording that counts seconds from its own start is put: its last sample at --end, or
/// at the end of the loop's newest settled slot, so that the next pass finds all of it.
std::int64_t end_time(const ImportOptions& options, const CatalogueEntry& entry,
                      std::int64_t now_us, const config::Settings& settings) {
  if (!options.end.empty())
    return time_option("--end", options.end, TimeZone(settings.plant.time_zone));
  const auto settle_us =
      static_cast<std::int64_t>(settings.schedule.settle_s * core::signal::kMicrosecondsPerSecond);
  return floor_to_period(now_us - settle_us, entry.period_s);
}

void shift(LoopRows& rows, std::int64_t by_us) {
  for (const TagRole& role : kTagRoles) {
    for (std::int64_t& time : (rows.*role.rows).time_us) time += by_us;
  }
}

/// Refuses to lay a recording over rows that are there: any row for one that seeks its own place,
/// rows from its first sample on for one whose times are given.
void require_no_history(storage::HistorianReader& historian, const CatalogueEntry& entry,
                        std::int64_t from_us, std::int64_t to_us, const TimeZone& zone,
                        const std::string& hint) {
  const auto newest = historian.newest(std::vector{entry.pv_tag}, to_us).front();
  if (!newest || *newest < from_us) return;
  throw Failure(ExitCode::usage,
                fmt::format("tag \"{}\" already has rows up to {}", entry.pv_tag,
                            second_in_zone(*newest, zone)),
                hint);
}

/// Gives a recording that counts seconds from its own start its place in time.
void place(const ImportOptions& options, const config::Settings& settings,
           const CatalogueEntry& entry, storage::HistorianReader& historian, Recording& recording) {
  const std::int64_t now_us = historian.now_us();
  const TimeZone zone(settings.plant.time_zone);
  const auto& times = recording.rows.pv.time_us;
  if (!recording.absolute_time) {
    if (options.end.empty()) {
      require_no_history(historian, entry, std::numeric_limits<std::int64_t>::min(), now_us, zone,
                         "say with --end TIME where a recording with t_s lies");
    }
    shift(recording.rows, end_time(options, entry, now_us, settings) - times.back());
  } else if (!options.end.empty()) {
    throw Failure(ExitCode::usage,
                  options.recording.file + ": --end with a file that has its own times",
                  "leave --end out: it places files with t_s");
  }
  if (!options.replace) {
    require_no_history(historian, entry, times.front(), times.back(), zone,
                       "--replace overwrites rows of the same times");
  }
}

void require_sound(const CatalogueEntry& entry) {
  try {
    check_entry(entry);
  } catch (const std::invalid_argument& problem) {
    throw Failure(ExitCode::usage, fmt::format("loop \"{}\": {}", entry.name, problem.what()),
                  "see loopscope import --help");
  }
}

std::vector<storage::TagRows> tag_rows(const CatalogueEntry& entry, LoopRows& rows) {
  std::vector<storage::TagRows> tags;
  for (const TagRole& role : kTagRoles) {
    if ((rows.*role.rows).empty()) continue;
    tags.push_back({entry.*role.tag, std::move(rows.*role.rows)});
  }
  return tags;
}

void import_recording(const ImportOptions& options) {
  const config::Settings settings = config::read_settings(options.config);
  Recording recording = read_recording(options.recording, TimeZone(settings.plant.time_zone));
  if (recording.rows.pv.empty()) {
    throw Failure(ExitCode::unusable_data, options.recording.file + ": the file has no rows",
                  "a recording needs at least one row below its header");
  }
  storage::Catalogue catalogue(owner_connection(settings));
  const CatalogueEntry entry =
      entry_for(options, settings, recording, catalogue.find(options.loop));
  require_sound(entry);
  // Saving nothing asks for the same rights: rows without a loop are not left behind.
  catalogue.save({});
  const config::HistorianSettings& source = find_historian(settings, entry.source);
  const auto writer = historian_writer_connection(source);
  const storage::SourceLayout layout = historian_layout(source);
  if (options.create_table) storage::create_historian_table(writer, layout);
  storage::HistorianReader historian(historian_connection(source), layout);
  place(options, settings, entry, historian, recording);
  const std::size_t rows =
      storage::import_rows(writer, layout, tag_rows(entry, recording.rows), options.replace);
  catalogue.save(std::vector{entry});
  std::cout << fmt::format("{}: {} imported\n", printable(entry.name),
                           core::text::counted(rows, "row", "rows"));
}

}  // namespace

void add_import(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "import", "Loads a recording into a historian table (demo and tests)");
  const auto options = std::make_shared<ImportOptions>();
  command.add_option("--config", options->config, "Settings file")->required();
  command.add_option("--loop", options->loop, "Loop; added to the catalogue if it is not there")
      ->required();
  add_recording_options(command, options->recording);
  command.add_option("--source", options->source, "Historian of the settings (default: the first)");
  command.add_option("--type", options->type, "Kind of loop: flow, pressure, level, ...");
  command.add_option("--op-range", options->op_range, "Controller output at 0 and 100 %: LOW,HIGH");
  command.add_option("--period-s", options->period_s, "Seconds between two analyses of this loop")
      ->check(CLI::PositiveNumber);
  command.add_option(
      "--end", options->end,
      "Time of the last sample of a file with t_s (default: the end of the loop's newest window)");
  command.add_flag("--create-table", options->create_table,
                   "Create the historian's table if missing");
  command.add_flag("--replace", options->replace, "Replace rows of the same tags and times");
  command.callback([options] { import_recording(*options); });
}

}  // namespace loopscope::daemon
