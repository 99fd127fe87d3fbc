#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>

#include "config/read_settings.hpp"
#include "config/time_zones.hpp"
#include "core/signal/grid.hpp"
#include "core/text/counted.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/commands/option_values.hpp"
#include "daemon/commands/recording_options.hpp"
#include "daemon/output/analysis_text.hpp"
#include "daemon/recording/analyse_windows.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

struct AnalyzeOptions {
  RecordingOptions recording;
  std::string config;
  std::string op_range;
  std::string pv_range;
  std::string type;
  std::string time_zone;
  std::size_t window = 0;
  bool json = false;
  bool no_model = false;
};

nlohmann::ordered_json windows_json(const WindowsAnalysis& analysis) {
  if (!analysis.newest_alone) return nullptr;
  return {{"judged", analysis.judged},
          {"together", analysis.together},
          {"newest_alone", verdict_json(*analysis.newest_alone)}};
}

/// The option before the settings; UTC where nothing is said.
TimeZone zone_of(const AnalyzeOptions& options, const config::Settings& settings) {
  if (options.time_zone.empty()) return TimeZone(settings.plant.time_zone);
  if (config::is_time_zone(options.time_zone)) return TimeZone(options.time_zone);
  throw Failure(ExitCode::usage,
                fmt::format("--time-zone \"{}\" is not the name of a time zone", options.time_zone),
                config::time_zone_hint(options.time_zone));
}

/// What was analysed; of a file with times also when that was.
std::string title_of(const AnalyzeOptions& options, const Recording& recording,
                     const core::signal::LoopWindow& window, const TimeZone& zone) {
  std::string title = fmt::format("{}: {} every {:.6g} s", printable(options.recording.file),
                                  core::text::counted(window.size(), "sample", "samples"),
                                  window.sample_interval_s);
  if (!recording.absolute_time || window.size() == 0) return title;
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  return title + fmt::format(", {} to {}", minute_in_zone(window.start_us, zone),
                             minute_in_zone(grid.time_us(window.size() - 1), zone));
}

void analyze(const AnalyzeOptions& options) {
  config::Settings whole;
  if (!options.config.empty()) whole = config::read_settings(options.config);
  core::AnalysisSettings& settings = whole.analysis;
  if (options.no_model) settings.fit_model = false;
  if (options.window > 0) settings.prepare.window_samples = options.window;
  const TimeZone zone = zone_of(options, whole);
  const Recording recording = read_recording(options.recording, zone);
  const std::optional<core::signal::OpRange> op_range = parse_op_range(options.op_range);
  core::LoopFacts facts{.integrating = core::is_integrating_type(options.type)};
  if (const auto pv_range = parse_pv_range(options.pv_range)) {
    facts.pv_span = pv_range->high - pv_range->low;
    facts.pv_low = pv_range->low;
  }
  // A window that was asked for is one look.
  const WindowsAnalysis analysis =
      options.window > 0 ? WindowsAnalysis{analyse_recording(recording, settings, op_range, facts)}
                         : analyse_windows(recording, settings, op_range, facts);
  const auto& [window, input, diagnosis] = analysis.newest;
  if (options.json) {
    nlohmann::ordered_json object = analysis_json(input, diagnosis);
    object["windows"] = windows_json(analysis);
    std::cout << json_text(object) << '\n';
  } else {
    std::cout << analysis_text(title_of(options, recording, window, zone), window.sample_interval_s,
                               diagnosis);
  }
}

}  // namespace

void add_analyze(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("analyze", "The whole diagnosis of one recording, no database");
  const auto options = std::make_shared<AnalyzeOptions>();
  add_recording_options(command, options->recording);
  command.add_flag("--json", options->json, "One JSON object instead of text");
  command.add_flag("--no-model", options->no_model,
                   "Statistics and shapes only: no loop model is fitted");
  command
      .add_option(
          "--window", options->window,
          "One analysis of the last N samples (default: windows of 4096, as many as cover the "
          "file, eight at most, judged together)")
      ->check(CLI::Range(16, 10'000'000));
  command.add_option("--op-range", options->op_range, "Controller output at 0 and 100 %: LOW,HIGH");
  command.add_option("--pv-range", options->pv_range, "Range of pv's transmitter: LOW,HIGH");
  command.add_option("--type", options->type,
                     "Kind of loop: flow, pressure, temperature, ...; level = integrating");
  command.add_option("--time-zone", options->time_zone,
                     "Zone of times in the file that say no offset, and of those in the text, e.g. "
                     "Europe/Berlin (default: /plant/time_zone of --config, else UTC)");
  command.add_option("--config", options->config,
                     "Settings file for the analysis part and the time zone");
  command.callback([options] { analyze(*options); });
}

}  // namespace loopscope::daemon
