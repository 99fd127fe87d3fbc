#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "core/plant/false_discovery.hpp"
#include "tests/core/diagnosis/uncoupled_verdicts.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::diagnosis {
namespace {

using loopscope::tables::require;
using tests::kFaulty;
using tests::kHealthy;
using tests::p_in_family;
using tests::shown;
using tests::uncoupled;

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

LOOPSCOPE_TABLE(verdict_uncoupled_branch, "loops shown, by p (minutes)") {
  std::puts("| scenario | loops | shown | p <= 1e-3 | 1e-4 | 1e-5 |");
  std::puts("|---|---|---|---|---|---|");
  for (const char* scenario : kHealthy) print_rates(scenario, 5000);
  for (const char* scenario : kFaulty) print_rates(scenario, 500);
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

LOOPSCOPE_TABLE(verdict_plants,
                "false and found flags of plants of 10 000 loops (a quarter of an hour)") {
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
    require(mean[i].wrong <= 0.06, "at most 6 % of the flags are false");
    require(mean[i].found >= 0.95, "at least 95 % of the faulty loops are flagged");
  }
}

}  // namespace
}  // namespace loopscope::core::diagnosis
