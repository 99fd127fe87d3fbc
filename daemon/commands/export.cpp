#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>

#include "config/nearest_name.hpp"
#include "config/read_settings.hpp"
#include "daemon/catalogue/unknown_loop.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/output/export_writer.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/read_time.hpp"
#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/reports/export_view.hpp"

namespace loopscope::daemon {
namespace {

struct ExportOptions {
  std::string config, view, loop, since;
  std::string format = "csv";
  std::string out = "-";
};

const storage::ExportedView& find_view(const std::string& name) {
  std::vector<std::string> names;
  for (const storage::ExportedView& view : storage::exported_views()) {
    if (name == view.name) return view;
    names.emplace_back(view.name);
  }
  const std::optional<std::string> nearest = config::nearest_name(name, names);
  throw Failure(ExitCode::usage, fmt::format("no view named \"{}\" to export", name),
                nearest
                    ? fmt::format("did you mean {}? loopscope export --help lists them", *nearest)
                    : "loopscope export --help lists them");
}

std::optional<std::int64_t> since_of(const ExportOptions& options,
                                     const storage::ExportedView& view, const TimeZone& zone) {
  if (options.since.empty()) return std::nullopt;
  if (*view.time_column == '\0') {
    throw Failure(ExitCode::usage, fmt::format("--since: {} has no time", view.name),
                  "leave it out");
  }
  return time_option("--since", options.since, zone);
}

storage::ExportRequest request_of(const ExportOptions& options, const TimeZone& zone) {
  const storage::ExportedView& view = find_view(options.view);
  if (!options.loop.empty() && !view.has_loop) {
    throw Failure(ExitCode::usage, fmt::format("--loop: {} is not about loops", view.name),
                  "leave it out");
  }
  return {&view, options.loop, since_of(options, view, zone)};
}

void export_view(const ExportOptions& options) {
  const config::Settings settings = config::read_settings(options.config);
  const storage::ExportRequest request = request_of(options, TimeZone(settings.plant.time_zone));
  const storage::ConnectionSettings connection = reader_connection(settings);
  if (!options.loop.empty()) {
    storage::Catalogue catalogue(connection);
    require_loop(options.loop, catalogue);
  }
  if (options.format == "json") {
    export_json(connection, request, options.out);
  } else {
    export_csv(connection, request, options.out);
  }
}

std::string list_of_views() {
  std::string text = "Views (one row per ...; --since filters by the column in brackets):";
  for (const storage::ExportedView& view : storage::exported_views()) {
    const std::string time =
        *view.time_column == '\0' ? "" : fmt::format(" [{}]", view.time_column);
    text += fmt::format("\n  {:<26}{}{}", view.name, view.shows, time);
  }
  return text;
}

}  // namespace

void add_export(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "export", "Writes a view of the results as CSV or JSON, for spreadsheets and scripts");
  const auto options = std::make_shared<ExportOptions>();
  command.add_option("--config", options->config, "Settings file")->required();
  command.add_option("VIEW", options->view, "View to write")->required();
  command.add_option("--format", options->format, "csv, or json: an array with a row a line")
      ->check(CLI::IsMember({"csv", "json"}));
  command.add_option("--loop", options->loop, "This loop alone");
  command.add_option(
      "--since", options->since,
      "ISO 8601: rows of this time and later; without an offset in the plant's zone");
  command.add_option("--out", options->out, "File to write, - for standard output");
  command.footer(list_of_views());
  command.callback([options] { export_view(*options); });
}

}  // namespace loopscope::daemon
