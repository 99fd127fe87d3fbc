// CPU time of explaining one window of 4096 samples, by what the loop of the scenario has.
//   build/release/tests/model_benchmark --benchmark_min_time=2

#include <algorithm>
#include <benchmark/benchmark.h>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "core/model/explain.hpp"
#include "core/simulate/scenario.hpp"
#include "daemon/service/threads/memory.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kSeeds = 5;

struct Window {
  simulate::LoopRecord record;
  std::vector<double> error;

  Window(std::string_view scenario, std::uint64_t seed)
      : record(simulate::simulate_scenario(scenario, {}, seed)), error(record.pv.size()) {
    std::ranges::transform(record.sp, record.pv, error.begin(), std::minus<>());
  }
  [[nodiscard]] ModelInput input() const {
    return {record.pv, record.op, record.sp, error, record.sample_interval_s, true, 1};
  }
};

double explain_ms(const Window& window) {
  const std::clock_t start = std::clock();
  benchmark::DoNotOptimize(explain(window.input()));
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Each iteration explains a window of every scenario; the seeds take turns.
void explain_scenarios(benchmark::State& state, const std::vector<std::string_view>& scenarios) {
  std::vector<Window> windows;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const std::string_view scenario : scenarios) windows.emplace_back(scenario, seed);
  }
  std::vector<double> times;
  std::size_t next = 0;
  while (state.KeepRunning()) {
    double sum = 0.0;
    for (std::size_t i = 0; i < scenarios.size(); ++i) {
      times.push_back(explain_ms(windows[next++ % windows.size()]));
      sum += times.back();
    }
    state.SetIterationTime(1e-3 * sum / static_cast<double>(scenarios.size()));
  }
  state.counters["median_ms"] = quantile(times, 0.5);
  state.counters["p90_ms"] = quantile(times, 0.9);
}

std::vector<std::string_view> loop_scenarios() {
  std::vector<std::string_view> names;
  for (const simulate::Scenario& scenario : simulate::all_scenarios()) {
    if (scenario.is_loop) names.push_back(scenario.name);
  }
  return names;
}

/// Times are means over the scenarios.
void add(const std::string& name, const std::vector<std::string_view>& scenarios) {
  benchmark::RegisterBenchmark(
      name.c_str(), [scenarios](benchmark::State& state) { explain_scenarios(state, scenarios); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace loopscope::core::model

int main(int argc, char** argv) {
  using loopscope::core::model::add;
  loopscope::daemon::bound_thread_caches();  // as the program does
  add("model/healthy", {"healthy_flow", "level_loop", "tight_tuning", "paper_5_1"});
  add("model/stiction", {"sticking_valve", "paper_5_4", "paper_5_4_kano", "square_limit_cycle"});
  add("model/deadband", {"deadband"});
  add("model/disturbance", {"outside_oscillation", "load_upsets", "paper_5_3"});
  add("model/curve", {"worn_valve", "nonlinear_process"});
  add("model/all", loopscope::core::model::loop_scenarios());
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
