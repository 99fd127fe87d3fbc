#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <string>

#include "config/read_settings.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/failure.hpp"
#include "daemon/output/window_csv.hpp"
#include "daemon/output/write_file.hpp"
#include "daemon/recording/time_text.hpp"
#include "daemon/service/storage_settings.hpp"
#include "daemon/service/window_reader.hpp"
#include "storage/results/catalogue.hpp"

namespace loopscope::daemon {
namespace {

struct WindowOptions {
  std::string config;
  std::string loop;
  std::string end;
  std::string out = "-";
};

/// The loop as a worker would hold it at the time from which the slot follows.
storage::ClaimedLoop claim_at(const storage::CatalogueEntry& loop, std::int64_t end_us,
                              double settle_s) {
  constexpr double kMicrosecondsPerSecond = 1e6;
  storage::ClaimedLoop claim;
  claim.loop = loop;
  claim.database_now_us = end_us + static_cast<std::int64_t>(settle_s * kMicrosecondsPerSecond);
  return claim;
}

void write_window(const WindowOptions& options) {
  const config::Settings settings = config::read_settings(options.config);
  const auto loop = storage::Catalogue(owner_connection(settings)).find(options.loop);
  if (!loop) {
    throw Failure(ExitCode::usage,
                  fmt::format("no loop named \"{}\" in the catalogue", options.loop),
                  "loopscope loops --config F lists them");
  }
  const config::HistorianSettings& source = find_historian(settings, loop->source);
  WindowSettings window_settings{settings.analysis.prepare.window_samples,
                                 settings.schedule.settle_s, SlotRule::newest_sample,
                                 mode_codes(source)};
  std::int64_t end_us = 0;
  if (!options.end.empty()) {
    const auto time = parse_time(options.end);
    if (!time) {
      throw Failure(ExitCode::usage, fmt::format("--end \"{}\" is not a time", options.end),
                    "write ISO 8601, e.g. 2026-03-01T12:00:00Z");
    }
    end_us = *time;
    window_settings.slot_rule = SlotRule::clock;
  }
  storage::HistorianReader historian(historian_connection(source), historian_layout(source));
  const storage::ClaimedLoop claim = claim_at(*loop, end_us, settings.schedule.settle_s);
  const std::vector<const storage::ClaimedLoop*> claims{&claim};
  const std::string text =
      window_csv(read_windows(historian, claims, window_settings).at(0).window);
  if (options.out == "-") {
    std::cout << text;
  } else {
    write_file(options.out, text);
  }
}

}  // namespace

void add_window(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "window", "Writes the window of a loop as it is read and aligned, as CSV for analyze");
  const auto options = std::make_shared<WindowOptions>();
  command.add_option("--config", options->config, "Settings file")->required();
  command.add_option("--loop", options->loop, "Loop of the catalogue")->required();
  command.add_option("--end", options->end,
                     "A time in the slot that ends before it (default: the newest slot)");
  command.add_option("--out", options->out, "File to write (default: standard output)");
  command.callback([options] { write_window(*options); });
}

}  // namespace loopscope::daemon
