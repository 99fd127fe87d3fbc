#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>

#include "config/read_settings.hpp"
#include "core/signal/window_digest.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/commands/option_values.hpp"
#include "daemon/failure.hpp"
#include "daemon/output/analysis_json.hpp"
#include "daemon/output/analysis_text.hpp"
#include "daemon/output/printable.hpp"
#include "daemon/recording/recording.hpp"
#include "daemon/recording/time_text.hpp"

namespace loopscope::daemon {
namespace {

struct AnalyzeOptions {
  std::string file;
  std::string config;
  std::string op_range;
  std::string type;
  std::size_t window = 0;
  bool json = false;
  bool no_model = false;
};

nlohmann::ordered_json time_json(std::int64_t time_us, bool absolute) {
  constexpr double kSecondsPerMicrosecond = 1e-6;
  if (absolute) return format_time(time_us);
  return static_cast<double>(time_us) * kSecondsPerMicrosecond;
}

InputFacts facts_of(const Recording& recording, const core::signal::LoopWindow& window) {
  InputFacts facts{recording.name, window.size(), std::nullopt, nullptr, nullptr};
  if (window.size() == 0) return facts;
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  if (window.size() > 1) facts.interval_s = window.sample_interval_s;
  facts.start = time_json(grid.start_us, recording.absolute_time);
  facts.end = time_json(grid.time_us(window.size() - 1), recording.absolute_time);
  return facts;
}

/// A recording's window, and its diagnosis with what the file holds before the window.
struct Analysis {
  core::signal::LoopWindow window;
  core::Diagnosis diagnosis;
};

Analysis analyse(const Recording& recording, const core::AnalysisSettings& settings,
                 const std::optional<core::signal::OpRange>& op_range, core::LoopFacts facts) {
  Analysis analysis;
  analysis.window = last_window(recording, settings.prepare.window_samples, op_range);
  const core::FirstLook first = core::first_look(analysis.window, settings);
  std::optional<core::signal::LoopWindow> longer;
  if (first.slow_span_samples > 0) {
    longer = last_window(recording, first.slow_span_samples, op_range);
  }
  facts.seed = core::signal::window_seed(analysis.window);
  analysis.diagnosis = core::diagnose(first, settings, facts, longer ? &*longer : nullptr);
  return analysis;
}

void analyze(const AnalyzeOptions& options) {
  core::AnalysisSettings settings;
  if (!options.config.empty()) settings = config::read_settings(options.config).analysis;
  if (options.no_model) settings.fit_model = false;
  if (options.window > 0) settings.prepare.window_samples = options.window;
  const Recording recording = read_recording(options.file);
  const auto [window, diagnosis] = analyse(recording, settings, parse_op_range(options.op_range),
                                           {.integrating = is_integrating_type(options.type)});
  if (options.json) {
    std::cout << json_text(analysis_json(facts_of(recording, window), diagnosis)) << '\n';
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
  command.add_option("--window", options->window, "Analyse the last N samples (default 4096)")
      ->check(CLI::Range(16, 10'000'000));
  command.add_option("--op-range", options->op_range, "Controller output at 0 and 100 %: LOW,HIGH");
  command.add_option("--type", options->type,
                     "Kind of loop: flow, pressure, temperature, ...; level = integrating");
  command.add_option("--config", options->config, "Settings file for the analysis part");
  command.callback([options] { analyze(*options); });
}

}  // namespace loopscope::daemon
