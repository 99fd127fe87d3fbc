#include "core/hos/coupling/nli_p.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>

#include "core/hos/analyse.hpp"
#include "core/hos/coupling/combine_p.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

using loopscope::tests::kTurn;

QuadraticTest paper_test() {
  return QuadraticTest(Settings{});
}

TEST(HosNliP, WithoutHarmonicsIsTheLargestCells) {
  const QuadraticTest test = paper_test();
  for (const double largest : {0.0, 5.0, 12.0, 200.0}) {
    const QuadraticStatistics found{1.0, largest};
    EXPECT_EQ(nli_p(test, found, std::nullopt), test.largest_p(found));
  }
}

TEST(HosNliP, CombinesCellsAndSecondHarmonic) {
  const QuadraticTest test = paper_test();
  const QuadraticStatistics found{1.0, 10.0};
  const double p = nli_p(test, found, HarmonicStatistics{50.0, 3.0, 40.0});
  EXPECT_DOUBLE_EQ(p, combine_p(std::array{test.largest_p(found), std::exp(-3.0)}));
  // The third harmonic is no business of it.
  EXPECT_EQ(p, nli_p(test, found, HarmonicStatistics{90.0, 3.0, 0.0}));
}

TEST(HosNliP, OneClearFindingCountsAsTwo) {
  const QuadraticTest test = paper_test();
  const QuadraticStatistics nothing{1.0, 4.0};
  const double second = nli_p(test, nothing, HarmonicStatistics{50.0, 30.0, 0.0});
  EXPECT_NEAR(second / std::exp(-30.0), 2.0, 1e-6);
  const QuadraticStatistics cell{1.0, 40.0};
  EXPECT_NEAR(nli_p(test, cell, HarmonicStatistics{50.0, 0.1, 0.0}) / test.largest_p(cell), 2.0,
              1e-6);
}

TEST(HosNliP, FallsWithEitherEvidenceAndStaysWithinZeroAndOne) {
  const QuadraticTest test = paper_test();
  double before = 1.0;
  for (double evidence = 0.0; evidence < 2000.0; evidence += 25.0) {
    const double by_harmonic = nli_p(test, {1.0, 2.0}, HarmonicStatistics{50.0, evidence, 0.0});
    const double by_cell = nli_p(test, {1.0, evidence}, HarmonicStatistics{50.0, 1.0, 0.0});
    EXPECT_GT(by_harmonic, 0.0);
    EXPECT_GT(by_cell, 0.0);
    EXPECT_LE(by_cell, 1.0);
    EXPECT_LE(by_harmonic, before);
    before = by_harmonic;
  }
}

/// A cosine and 30 % of its second harmonic.
double bent(double turn) {
  return std::numbers::sqrt2 * (std::cos(kTurn * turn) + 0.3 * std::cos(2.0 * kTurn * turn));
}

TEST(HosNliP, SeesASecondHarmonicThatSegmentsOf64CannotHold) {
  const int records = tests::records(60);
  for (const double period : {100.0, 400.0}) {
    double seen = 0.0;
    double seen_by_all = 0.0;
    for (int seed = 1; seed <= records; ++seed) {
      const auto drawn = static_cast<std::uint64_t>(seed);
      const auto found = analyse(tests::jittered_wave(drawn, period, 4096, bent), {}, drawn);
      seen += found->nli_p.value() <= 0.05 ? 1.0 / records : 0.0;
      seen_by_all += found->nonlinear_p.value() <= 0.05 ? 1.0 / records : 0.0;
    }
    std::printf("| second harmonic 30 %%, period %.0f | %.1f %% | %.1f %% |\n", period,
                100.0 * seen, 100.0 * seen_by_all);
    EXPECT_GE(seen, 0.95 - four_errors(0.95, records)) << period;
  }
}

}  // namespace
}  // namespace loopscope::core::hos
