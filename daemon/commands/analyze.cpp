#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>

#include "config/read_settings.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/commands/option_values.hpp"
#include "daemon/output/analysis_text.hpp"
#include "daemon/recording/analyse_windows.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"

namespace loopscope::daemon {
namespace {

struct AnalyzeOptions {
  std::string file;
  std::string config;
  std::string op_range;
  std::string pv_range;
  std::string type;
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

void analyze(const AnalyzeOptions& options) {
  core::AnalysisSettings settings;
  if (!options.config.empty()) settings = config::read_settings(options.config).analysis;
  if (options.no_model) settings.fit_model = false;
  if (options.window > 0) settings.prepare.window_samples = options.window;
  const Recording recording = read_recording(options.file);
  const std::optional<core::signal::OpRange> op_range = parse_op_range(options.op_range);
  const core::LoopFacts facts{.integrating = core::is_integrating_type(options.type),
                              .pv_span = parse_pv_span(options.pv_range)};
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
    const auto title = fmt::format("{}: {} samples every {:.6g} s", printable(options.file),
                                   window.size(), window.sample_interval_s);
    std::cout << analysis_text(title, window.sample_interval_s, diagnosis);
  }
}

}  // namespace

void add_analyze(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("analyze", "The whole diagnosis of one recording, no database");
  const auto options = std::make_shared<AnalyzeOptions>();
  command
      .add_option("FILE", options->file, "CSV: t_s or time, sp, pv, op, optional mv, mode, quality")
      ->required();
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
  command.add_option("--config", options->config, "Settings file for the analysis part");
  command.callback([options] { analyze(*options); });
}

}  // namespace loopscope::daemon
