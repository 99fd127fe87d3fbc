#include <CLI/CLI.hpp>
#include <cstdint>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/simulate/scenario.hpp"
#include "daemon/lab/commands/commands.hpp"
#include "daemon/lab/simulate/effect_text.hpp"
#include "daemon/lab/simulate/parse_numbers.hpp"
#include "daemon/lab/simulate/record_csv.hpp"
#include "daemon/output/output_file.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {

namespace {

struct SimulateOptions {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string out;
  std::size_t samples = 4096;
  std::optional<double> interval_s;  ///< nullopt = the scenario's own
  std::vector<std::string> effects;
  bool no_mv = false;
  bool list = false;
};

std::string listing() {
  std::string text = "Scenarios\n";
  for (const core::simulate::Scenario& scenario : core::simulate::all_scenarios()) {
    text += fmt::format("  {:<22}{}\n", scenario.name, scenario.description);
  }
  text += "\nEffects, for --effect NAME:PARAMETER=VALUE,...\n";
  for (const core::simulate::EffectDescription& effect : core::simulate::all_effects()) {
    text += fmt::format("  {:<22}{}\n  {:<22}{}\n", effect.name, effect.usage, "", effect.formula);
  }
  return text;
}

core::simulate::LoopRecord record_of(const SimulateOptions& options) {
  core::simulate::ScenarioOptions scenario;
  scenario.samples = options.samples;
  scenario.sample_interval_s = options.interval_s;
  for (const std::string& text : options.effects) {
    scenario.added_effects.push_back(parse_effect(text));
  }
  try {
    return core::simulate::simulate_scenario(options.scenario, scenario, options.seed);
  } catch (const std::invalid_argument& error) {
    throw Failure(ExitCode::usage, error.what(),
                  "loopscope simulate --list shows what goes together");
  }
}

void simulate(const SimulateOptions& options) {
  if (options.list) {
    std::cout << listing();
    return;
  }
  if (options.scenario.empty()) {
    throw Failure(ExitCode::usage, "no scenario is named",
                  "loopscope simulate --list shows every scenario");
  }
  require_scenario(options.scenario);
  const std::string csv = record_csv(record_of(options), !options.no_mv);
  if (options.out.empty()) {
    std::cout << csv;
  } else {
    write_file(options.out, csv);
  }
}

}  // namespace

void add_simulate(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "simulate", "The paper's signals and loops, and plant loops with any list of effects");
  const auto options = std::make_shared<SimulateOptions>();
  command.add_option("SCENARIO", options->scenario, "One of --list");
  command.add_option_function<std::string>(
      "--seed", [options](const std::string& text) { options->seed = parse_seed(text); },
      "The same seed gives the same record (default 1)");
  command.add_option("--out", options->out, "File to write; standard output without it");
  command.add_option("--samples", options->samples, "Samples to record (default 4096)")
      ->check(CLI::Range(1, 10'000'000));
  command.add_option_function<std::string>(
      "--interval-s",
      [options](const std::string& text) { options->interval_s = parse_interval_s(text); },
      "Seconds between samples, 1e-6 to 1e6 (default: the scenario's own)");
  command.add_option("--effect", options->effects,
                     "Adds an effect, e.g. valve_stiction:S=3,J=1 (repeatable, loops only)");
  command.add_flag("--no-mv", options->no_mv, "Leave the valve position out");
  command.add_flag("--list", options->list, "Show every scenario and effect");
  command.callback([options] { simulate(*options); });
}

}  // namespace loopscope::daemon
