// Time of one window of 4096 samples in each stage of the analysis but the loop model: healthy
// loops of the simulated plant, in turn.

#include <benchmark/benchmark.h>
#include <string_view>
#include <vector>

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "core/signal/window_digest.hpp"
#include "core/simulate/scenario.hpp"
#include "daemon/service/threads/memory.hpp"

namespace loopscope::core {
namespace {

constexpr std::string_view kHealthy[] = {"healthy_flow", "paper_5_1", "level_loop"};
/// Each with several seeds: rare second passes count with their share.
constexpr std::uint64_t kSeeds = 20;

signal::LoopWindow window_of(std::string_view scenario, std::uint64_t seed) {
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, seed);
  signal::LoopWindow window;
  window.sample_interval_s = record.sample_interval_s;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  window.op_range = signal::OpRange{0.0, 100.0};
  return window;
}

struct HealthyLoop {
  signal::LoopWindow window;
  LoopFacts facts;
};

const std::vector<HealthyLoop>& healthy_loops() {
  static const std::vector<HealthyLoop> loops = [] {
    std::vector<HealthyLoop> made;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      for (const std::string_view scenario : kHealthy) {
        const bool integrating = scenario == "level_loop";
        made.push_back({window_of(scenario, seed), {.integrating = integrating, .seed = seed}});
      }
    }
    return made;
  }();
  return loops;
}

/// `use` on one healthy loop after the other.
template <typename Use>
void each_in_turn(benchmark::State& state, Use use) {
  const std::vector<HealthyLoop>& loops = healthy_loops();
  std::size_t next = 0;
  for (auto _ : state) {
    use(loops[next], next);
    next = (next + 1) % loops.size();
  }
}

void prepare(benchmark::State& state) {
  each_in_turn(state, [](const HealthyLoop& loop, std::size_t) {
    benchmark::DoNotOptimize(first_look(loop.window, {}));
  });
}

void statistics(benchmark::State& state) {
  std::vector<FirstLook> looks;
  for (const HealthyLoop& loop : healthy_loops()) looks.push_back(first_look(loop.window, {}));
  each_in_turn(state, [&](const HealthyLoop& loop, std::size_t number) {
    benchmark::DoNotOptimize(gather_evidence(looks[number], {}, loop.facts));
  });
}

void digest(benchmark::State& state) {
  each_in_turn(state, [](const HealthyLoop& loop, std::size_t) {
    benchmark::DoNotOptimize(signal::window_digest(loop.window, "{}"));
    benchmark::DoNotOptimize(signal::window_seed(loop.window));
  });
}

/// As the program does.
const bool kKept = (daemon::bound_thread_caches(), true);

BENCHMARK(prepare)->Name("analysis/prepare")->Unit(benchmark::kMicrosecond);
BENCHMARK(statistics)->Name("analysis/statistics")->Unit(benchmark::kMicrosecond);
BENCHMARK(digest)->Name("analysis/digest")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace loopscope::core
