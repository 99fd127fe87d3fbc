#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/read_settings.hpp"
#include "core/signal/microseconds.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/output/output_file.hpp"
#include "daemon/output/window_csv.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/windows/loop_slot.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "daemon/service/windows/window_reader.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/read_time.hpp"
#include "storage/results/catalogue/catalogue.hpp"

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
  storage::ClaimedLoop claim;
  claim.loop = loop;
  claim.database_now_us =
      end_us + static_cast<std::int64_t>(settle_s * core::signal::kMicrosecondsPerSecond);
  return claim;
}

std::optional<std::int64_t> end_of(const WindowOptions& options, const config::Settings& settings) {
  if (options.end.empty()) return std::nullopt;
  return time_option("--end", options.end, TimeZone(settings.plant.time_zone));
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
  const auto end_us = end_of(options, settings);
  storage::HistorianReader historian(historian_connection(source), historian_layout(source));
  const storage::ClaimedLoop claim =
      claim_at(*loop, end_us.value_or(historian.now_us()), settings.schedule.settle_s);
  const SlotSettings slot_settings{settings.schedule.settle_s,
                                   end_us ? SlotRule::clock : SlotRule::newest_sample};
  const auto slots =
      newest_slots(historian, std::vector{&claim}, slot_settings, historian.now_us());
  RowMemory memory;
  const auto windows =
      read_windows(historian, slots, settings.analysis.prepare.window_samples, memory);
  const core::signal::LoopWindow& window = windows.at(0).window;
  if (window.size() == 0) {
    throw Failure(ExitCode::unusable_data,
                  fmt::format("loop \"{}\": no row of its pv tag in the window", loop->name),
                  "loopscope loops check --config F lists the tags that lead nowhere");
  }
  const std::string text = window_csv(window);
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
  command.add_option(
      "--end", options->end,
      "Time before which the window ends (default: the newest window); without an offset "
      "it is meant in the plant's zone");
  command.add_option("--out", options->out, "File to write (default: standard output)");
  command.callback([options] { write_window(*options); });
}

}  // namespace loopscope::daemon
