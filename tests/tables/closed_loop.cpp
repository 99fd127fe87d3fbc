#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>

#include "core/model/controller/excitation.hpp"
#include "core/model/controller/inverse_controller_fit.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/known_loops.hpp"
#include "tests/core/model/tuning_cases.hpp"
#include "tests/tables/table.hpp"

/// The tables of core/model/controller/MEASURED.md. Disabled, because they assert nothing that the
/// other tests do not assert on fewer seeds.
namespace loopscope::core::model {
namespace {

constexpr std::uint64_t kLoops = 100;
constexpr std::uint64_t kTrapLoops = 500;

void print_scenario(std::string_view name) {
  const known::KnownLoop loop = known::scenario(name);
  int laws = 0, excited = 0, refused = 0, caught = 0;
  known::TuningCounts tuning;
  for (std::uint64_t seed = 1; seed <= kLoops; ++seed) {
    const known::Records records = known::run(loop.settings, seed);
    const ControllerLaw law = known::find_law(records);
    const ProcessFit fit = known::off_by_a_fifth(loop.process, seed);
    laws += law.found;
    excited += judge_excitation({records.op, records.pv, true, {}}).sufficient;
    refused += judge_inverse_controller_fit(fit, law, records.op, 1.0).refused;
    caught +=
        judge_inverse_controller_fit(known::fit_without_delay(records, 1), law, records.op).refused;
    ++tuning.judged[static_cast<std::size_t>(judge_tuning(fit, law, 1.0).tuning)];
  }
  std::printf("| %s | %d | %d | %d | %d | %zu | %zu | %zu | %zu |\n", std::string(name).c_str(),
              laws, excited, refused, caught, tuning.judged[0], tuning.judged[1], tuning.judged[2],
              tuning.judged[3]);
}

LOOPSCOPE_TABLE(closed_loop_scenarios, "laws, excitation, traps and tuning by scenario") {
  for (const simulate::Scenario& scenario : simulate::all_scenarios()) {
    if (scenario.is_loop) print_scenario(scenario.name);
  }
}

void print_trap(double op_step, double pv_noise) {
  int right = 0, first = 0, second = 0, found = 0;
  for (std::uint64_t seed = 1; seed <= kTrapLoops; ++seed) {
    const known::KnownLoop loop = known::random_loop(seed);
    known::Records records = known::run(loop.settings, seed);
    known::blur(records, op_step, pv_noise, seed);
    const ControllerLaw law = known::find_law(records);
    found += law.found;
    const ProcessFit fit = known::off_by_a_fifth(loop.process, seed);
    right += judge_inverse_controller_fit(fit, law, records.op, 1.0).refused;
    first +=
        judge_inverse_controller_fit(known::fit_without_delay(records, 1), law, records.op).refused;
    second +=
        judge_inverse_controller_fit(known::fit_without_delay(records, 2), law, records.op).refused;
  }
  const double percent = 100.0 / static_cast<double>(kTrapLoops);
  std::printf("| op to %.2g %%, pv noise %.2g std | %.1f %% | %.1f %% | %.1f %% | %.1f %% |\n",
              op_step, pv_noise, percent * found, percent * right, percent * first,
              percent * second);
}

LOOPSCOPE_TABLE(closed_loop_trap, "fits that a controller explains, of random loops") {
  print_trap(0.0, 0.0);
  print_trap(0.01, 0.0);
  print_trap(0.1, 0.0);
  print_trap(0.0, 0.1);
  print_trap(0.0, 0.3);
}

void print_counts(const char* name, const known::TuningCounts& counts) {
  std::printf("| %s | %zu | %.1f %% | %.1f %% | %.1f %% | %.1f %% |\n", name, counts.total(),
              100.0 * counts.share(Tuning::fine), 100.0 * counts.share(Tuning::tight),
              100.0 * counts.share(Tuning::sluggish), 100.0 * counts.share(Tuning::contradictory));
}

LOOPSCOPE_TABLE(closed_loop_tuning, "judgements of tuning by how the loops are tuned") {
  const known::TuningRates rates = known::tuning_rates(4000);
  print_counts("fine", rates.fine);
  print_counts("tight", rates.tight);
  print_counts("sluggish", rates.sluggish);
  print_counts("averaging", rates.averaging);
}

template <typename Work>
void print_cost(const char* name, Work&& work) {
  constexpr int kRepeats = 100;
  const std::clock_t start = std::clock();
  for (int i = 0; i < kRepeats; ++i) work();
  std::printf("| %s | %.0f us |\n", name,
              1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / kRepeats);
}

LOOPSCOPE_TABLE(closed_loop_cost, "microseconds of each judgement") {
  const known::KnownLoop loop = known::scenario("healthy_flow");
  known::Records records = known::run(loop.settings, 1);
  known::blur(records, 0.5, 0.0, 1);  // the search visits every span
  const ControllerLaw law = known::find_law(records);
  ProcessFit late = loop.process;
  late.delay_s = 12.0;
  print_cost("controller_law", [&] { (void)known::find_law(records); });
  print_cost("excitation", [&] {
    (void)judge_excitation({records.op, records.pv, true, records.pv});
  });
  print_cost("inverse_controller_fit",
             [&] { (void)judge_inverse_controller_fit(late, law, records.op, 1.0); });
  print_cost("tuning, delay 2", [&] { (void)judge_tuning(loop.process, law, 1.0); });
  print_cost("tuning, delay 12", [&] { (void)judge_tuning(late, law, 1.0); });
  late.delay_s = 25.0;
  print_cost("tuning, delay 25", [&] { (void)judge_tuning(late, law, 1.0); });
}

}  // namespace
}  // namespace loopscope::core::model
