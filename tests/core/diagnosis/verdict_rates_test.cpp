#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/diagnose.hpp"
#include "core/plant/false_discovery.hpp"
#include "core/simulate/scenario.hpp"

/// How often loops of core/simulate are flagged by the branch without coupling, alone and under the
/// plant's false-discovery control: the tables of core/diagnosis and core/plant. The long runs are
/// disabled (minutes to a quarter of an hour).
namespace loopscope::core::diagnosis {
namespace {

constexpr std::array kHealthy{"healthy_flow", "paper_5_1", "paper_5_2_printed", "level_loop"};
constexpr std::array kFaulty{"tight_tuning",   "outside_oscillation", "paper_5_3",
                             "sticking_valve", "square_limit_cycle",  "paper_5_2_excessive",
                             "paper_5_4_kano"};
/// config/, flags.min_confidence.
constexpr double kMinConfidence = 0.3;

/// The verdict of a loop without its coupling, which has calibrated tests of its own.
Verdict uncoupled(const std::string& scenario, std::uint64_t seed) {
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, seed);
  signal::LoopWindow window;
  window.sample_interval_s = record.sample_interval_s;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  AnalysisSettings settings;
  settings.fit_model = false;  // the branch of the flow that decides where no model is fitted
  const LoopFacts facts{.integrating = scenario.find("level") != std::string::npos};
  Evidence evidence = diagnose(window, settings, facts).evidence;
  evidence.hos->ngi = -1.0;
  evidence.hos->nonlinear_p = 1.0;
  return decide(evidence, settings.hos);
}

bool shown(const Verdict& verdict) {
  return verdict.code != VerdictCode::healthy && verdict.code != VerdictCode::insufficient_data &&
         verdict.confidence >= kMinConfidence;
}

void print_rates(const std::string& scenario, int loops) {
  constexpr std::array kSizes{1.0, 1e-3, 1e-4, 1e-5};
  std::array<int, kSizes.size()> counts{};
  for (int k = 0; k < loops; ++k) {
    const Verdict verdict = uncoupled(scenario, 900'000 + static_cast<std::uint64_t>(k));
    if (!shown(verdict)) continue;
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
      counts[i] += verdict.p.value_or(0.0) <= kSizes[i] ? 1 : 0;
    }
  }
  std::printf("| %s | %d |", scenario.c_str(), loops);
  for (const int count : counts) std::printf(" %.4g |", static_cast<double>(count) / loops);
  std::puts("");
  std::fflush(stdout);
}

TEST(VerdictRates, DISABLED_UncoupledBranch) {
  std::puts("| scenario | loops | shown | p <= 1e-3 | 1e-4 | 1e-5 |");
  std::puts("|---|---|---|---|---|---|");
  for (const char* scenario : kHealthy) print_rates(scenario, 5000);
  for (const char* scenario : kFaulty) print_rates(scenario, 500);
}

/// p that a loop brings into the family: of its verdict, or 1 where nothing is shown.
double p_in_family(const Verdict& verdict) {
  return shown(verdict) ? verdict.p.value_or(1.0) : 1.0;
}

/// A plant's healthy loops and more faulty ones than it may need.
struct Pool {
  std::vector<double> healthy, faulty;
};

constexpr std::size_t kLoops = 10'000, kMostFaulty = 200;
constexpr std::size_t kTestsPerLoop = 3;
/// A coupling test of exact size, and the level at which it would take the verdict over.
constexpr double kCouplingLevel = 0.01;

Pool draw_pool(std::uint64_t plant) {
  std::mt19937_64 random(plant);
  std::uniform_real_distribution<double> uniform;
  const std::uint64_t first = 2'000'000 + 20'000 * plant;
  Pool pool;
  for (std::size_t k = 0; k < kLoops; ++k) {
    const double p = p_in_family(uncoupled(kHealthy[k % kHealthy.size()], first + k));
    const double coupling_p = uniform(random);
    pool.healthy.push_back(coupling_p <= kCouplingLevel ? coupling_p : p);
  }
  for (std::size_t k = 0; k < kMostFaulty; ++k) {
    pool.faulty.push_back(p_in_family(uncoupled(kFaulty[k % kFaulty.size()], first + kLoops + k)));
  }
  return pool;
}

struct Shares {
  double wrong = 0.0;  ///< of the flags
  double found = 0.0;  ///< of the faulty loops
};

/// The first `faulty` loops of the plant are faulty; those of a small plant are spread over the
/// kinds of fault.
Shares control(const Pool& pool, std::size_t faulty, std::uint64_t plant) {
  std::vector<double> family;
  for (std::size_t k = 0; k < faulty; ++k) {
    family.push_back(pool.faulty[(25 * k + plant) % kMostFaulty]);
  }
  family.insert(family.end(), pool.healthy.begin() + static_cast<std::ptrdiff_t>(faulty),
                pool.healthy.end());
  family.resize(kTestsPerLoop * kLoops, 1.0);
  const std::vector<bool> flagged = plant::control_false_discovery(family, 0.05).flagged;
  const auto first_healthy = flagged.begin() + static_cast<std::ptrdiff_t>(faulty);
  const auto found = static_cast<double>(std::count(flagged.begin(), first_healthy, true));
  const auto wrong = static_cast<double>(std::count(first_healthy, flagged.end(), true));
  return {wrong / std::max(1.0, wrong + found), found / static_cast<double>(faulty)};
}

TEST(VerdictRates, DISABLED_Plants) {
  constexpr std::uint64_t kPlants = 20;
  constexpr std::array<std::size_t, 2> kFaultyLoops{200, 10};
  std::array<Shares, kFaultyLoops.size()> mean{};
  for (std::uint64_t plant = 1; plant <= kPlants; ++plant) {
    const Pool pool = draw_pool(plant);
    for (std::size_t i = 0; i < kFaultyLoops.size(); ++i) {
      const Shares shares = control(pool, kFaultyLoops[i], plant);
      mean[i].wrong += shares.wrong / kPlants;
      mean[i].found += shares.found / kPlants;
    }
  }
  for (std::size_t i = 0; i < kFaultyLoops.size(); ++i) {
    std::printf("%zu of %zu faulty: %.2f %% of the flags false, %.2f %% of the faulty flagged\n",
                kFaultyLoops[i], kLoops, 100.0 * mean[i].wrong, 100.0 * mean[i].found);
    EXPECT_LE(mean[i].wrong, 0.06);
    EXPECT_GE(mean[i].found, 0.95);
  }
}

/// In a plant of 10 000 loops with ten faulty ones p has to be below about 1e-5.
TEST(VerdictRates, HealthyLoopsDoNotReachThePlantsThresholdAndFaultyOnesDo) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    for (const char* scenario : kHealthy) EXPECT_GT(p_in_family(uncoupled(scenario, seed)), 1e-4);
  }
  for (const char* scenario : kFaulty) {
    int certain = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      certain += p_in_family(uncoupled(scenario, seed)) <= 1e-5 ? 1 : 0;
    }
    EXPECT_GE(certain, 18) << scenario;
  }
}

/// A good loop under a load that drifts is as far from the best: only a controller that is known
/// tells the two apart.
TEST(VerdictRates, SlownessIsNotShownWithoutTheController) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_FALSE(shown(uncoupled("sluggish_tuning", seed)));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
