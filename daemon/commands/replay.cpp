#include <CLI/CLI.hpp>
#include <cstdint>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <string>

#include "config/read_settings.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/output/text_line.hpp"
#include "daemon/replay/compare_figures.hpp"
#include "daemon/replay/record_figures.hpp"
#include "daemon/replay/repeat_analysis.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/results/reports/analysis_archive.hpp"

namespace loopscope::daemon {
namespace {

struct ReplayOptions {
  std::string config;
  std::int64_t analysis_id = 0;
};

storage::StoredAnalysis find(storage::AnalysisArchive& archive, std::int64_t analysis_id) {
  if (auto stored = archive.find(analysis_id)) return *std::move(stored);
  throw Failure(ExitCode::usage, fmt::format("no analysis has the number {}", analysis_id),
                "loopscope.latest_verdict and loopscope.loop_history have them (analysis_id)");
}

std::string outcome(const FigureComparison& figures) {
  if (figures.different == 0) return fmt::format("identical: all {} figures", figures.compared);
  return fmt::format(
      "{} of {} figures differ, the farthest {}: {} then, {} now{}", figures.different,
      figures.compared, figures.name, figures.before, figures.after,
      figures.relative < 2.0 ? fmt::format(" (by {:.2g} of it)", figures.relative) : std::string());
}

/// Why the two may differ, where something is known to be different.
std::string causes(const storage::StoredAnalysis& stored, const storage::AnalysisRecord& now) {
  std::string text;
  if (stored.input_digest != now.input_digest)
    text += text_line("input",
                      "differs: rows of the historian, the loop's entry in the catalogue "
                      "or the known settings have changed since");
  if (stored.program_version != now.program_version)
    text += text_line("program", stored.program_version + " then, " + now.program_version + " now");
  if (stored.algorithm_revision != now.algorithm_revision)
    text += text_line("algorithm", fmt::format("revision {} then, {} now",
                                               stored.algorithm_revision, now.algorithm_revision));
  return text;
}

std::string verdict_text(const nlohmann::json& figures) {
  const nlohmann::json& verdict = figures.at("verdict");
  return fmt::format("{}, confidence {:.3f}", verdict.at("code").get<std::string>(),
                     verdict.at("confidence").get<double>());
}

void replay(const ReplayOptions& options) {
  const config::Settings settings = config::read_settings(options.config);
  storage::AnalysisArchive archive(results_connection(settings));
  const storage::StoredAnalysis stored = find(archive, options.analysis_id);
  const storage::AnalysisRecord now = repeat_analysis(settings, stored);
  const auto before = nlohmann::json::parse(stored.figures_json);
  const auto after = record_figures(now, archive.measured_columns(now));
  std::cout << text_line("loop", printable(stored.loop.name))
            << text_line("window end",
                         format_time(stored.slot_end_us, TimeZone(settings.plant.time_zone)))
            << text_line("then", verdict_text(before)) << text_line("now", verdict_text(after))
            << causes(stored, now)
            << text_line("figures", printable(outcome(compare_figures(before, after))));
}

}  // namespace

void add_replay(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "replay", "Recomputes a stored verdict from the historian and compares every figure");
  const auto options = std::make_shared<ReplayOptions>();
  command.add_option("--config", options->config, "Settings file")->required();
  command
      .add_option("ANALYSIS_ID", options->analysis_id,
                  "Number of the analysis (latest_verdict, loop_history)")
      ->required();
  command.callback([options] { replay(*options); });
}

}  // namespace loopscope::daemon
