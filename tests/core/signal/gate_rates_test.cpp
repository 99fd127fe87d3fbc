// How often healthy loops are called nonlinear after their data were damaged on the way, how many
// are judged at all, and how often nonlinear ones are still found. The tables of MEASURED.md are
// what these tests print.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "tests/core/signal/damages.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::signal {
namespace {

/// Of each loop; LOOPSCOPE_RECORDS=30 gives MEASURED.md's tables.
constexpr std::size_t kGateRecords = 12;
/// Other seeds than those on which the limits were chosen.
constexpr std::uint64_t kFirstSeed = 900'000;

constexpr std::array kHealthy = {"broad",        "osc",       "noisy_osc",           "white",
                                 "healthy_flow", "paper_5_1", "paper_5_2_excessive", "level_loop"};
constexpr std::array kNonlinear = {"sticking_valve", "square_limit_cycle", "paper_5_4",
                                   "paper_5_4_kano", "paper_4_1_nonlinear"};

using P = std::optional<double> hos::Result::*;
constexpr std::array<P, 4> kTests = {&hos::Result::nonlinear_p, &hos::Result::ngi_p,
                                     &hos::Result::nli_p, &hos::Result::cubic_p};

struct GateCounts {
  int records = 0;
  int judged = 0;
  std::array<int, 4> computed{};
  std::array<int, 4> rejected{};
  double factor = 0.0;

  void add(const Evidence& evidence) {
    ++records;
    factor += evidence.data_quality.compression_factor.value_or(1.0);
    if (!evidence.hos || !evidence.hos->nonlinear_p) return;
    ++judged;
    for (std::size_t i = 0; i < kTests.size(); ++i) {
      const std::optional<double>& p = (*evidence.hos).*kTests[i];
      computed[i] += p ? 1 : 0;
      rejected[i] += p.value_or(1.0) < 0.05 ? 1 : 0;
    }
  }
  [[nodiscard]] double rate(std::size_t test) const {
    return computed[test] > 0 ? double(rejected[test]) / computed[test] : 0.0;
  }
  void print(const char* what) const {
    std::printf("| %s | %.1f %% | %.2f ", what, 100.0 * judged / records, factor / records);
    for (std::size_t i = 0; i < kTests.size(); ++i) std::printf("| %.1f %% ", 100.0 * rate(i));
    std::printf("|\n");
    std::fflush(stdout);
  }
};

void add(const Damage& damage, const char* loop, int records, GateCounts& rates) {
  AnalysisSettings settings;
  settings.fit_model = false;
  for (int i = 0; i < records; ++i) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(i);
    const LoopWindow window = window_of(damage.apply(recording_of(loop, seed), seed));
    rates.add(diagnose(window, settings, {.integrating = false, .seed = seed}).evidence);
  }
}

class GateRates : public testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] static const Damage& damage() { return all_damages()[GetParam()]; }

  /// `share` of the records that were asked for, of every loop.
  [[nodiscard]] static GateCounts measure(std::span<const char* const> loops, int share) {
    GateCounts rates;
    const int records =
        std::max(1, static_cast<int>(loopscope::tests::records(kGateRecords)) / share);
    for (const char* const loop : loops) add(damage(), loop, records, rates);
    rates.print(damage().name.c_str());
    return rates;
  }
};

TEST_P(GateRates, HealthyLoopsStayHealthy) {
  const GateCounts rates = measure(kHealthy, 1);
  EXPECT_GE(rates.judged, 0.9 * rates.records);
  for (std::size_t i = 0; i < kTests.size(); ++i) {
    // 5 % by chance; the project allows 7 % in the long run.
    EXPECT_LE(rates.rate(i), 0.05 + loopscope::tests::four_errors(0.05, rates.records))
        << "test " << i;
  }
}

TEST_P(GateRates, NonlinearLoopsAreFound) {
  const GateCounts rates = measure(kNonlinear, 3);
  if (damage().leaves_linear) {
    EXPECT_LE(rates.rate(0), 0.05 + loopscope::tests::four_errors(0.05, rates.records));
  } else {
    // All of them are found in whole data; the loudest damages hide half of them.
    EXPECT_GE(rates.rate(0), 0.4);
  }
}

/// The short form takes the quick ones.
std::vector<std::size_t> chosen_damages() {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < all_damages().size(); ++i) {
    if (loopscope::tests::is_long_run() || is_quick(all_damages()[i])) chosen.push_back(i);
  }
  return chosen;
}

INSTANTIATE_TEST_SUITE_P(Damages, GateRates, testing::ValuesIn(chosen_damages()),
                         [](const auto& tested) { return std::to_string(tested.param); });

}  // namespace
}  // namespace loopscope::core::signal
