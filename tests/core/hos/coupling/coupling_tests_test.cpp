#include "core/hos/coupling/coupling_tests.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>

#include "core/hos/analyse.hpp"
#include "core/hos/coupling/combine_p.hpp"
#include "core/hos/coupling/null_laws.hpp"
#include "core/hos/coupling/quadratic_test.hpp"
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

TEST(HosCouplingTests, AreThoseOfTheirStatistics) {
  const auto signal = tests::coloured(simulate::Innovation::laplace, 0.9, 3);
  Bicoherence bicoherence(Settings{});
  const TestedSpectra tested(signal, bicoherence, bicoherence.estimate(signal), Settings{});
  const HarmonicTest harmonics(30.0);
  const CouplingTests found = test_coupling(tested, &harmonics);
  const QuadraticTest test(tested.settings());
  const auto quadratic = test.measure(tested.bicoherence(), tested.bic2());
  const auto coherence = harmonics.measure(tested.signal());
  EXPECT_EQ(found.mean_p, test.mean_p(quadratic, tested.bicoherence().segments()));
  EXPECT_EQ(found.nli_p, nli_p(test, quadratic, coherence));
  EXPECT_EQ(found.cubic_p, p_of_evidence(coherence->cubic_evidence));
  EXPECT_FALSE(test_coupling(tested, nullptr).cubic_p.has_value());
}

TEST(HosCouplingTests, CombineByCauchy) {
  const CouplingTests all{.mean_p = 0.2, .nli_p = 0.01, .cubic_p = 0.5};
  EXPECT_DOUBLE_EQ(all.combined(), 0.87 * combine_p(std::array{0.2, 0.01, 0.5}));
  EXPECT_DOUBLE_EQ(all.quadratic(), combine_p(std::array{0.2, 0.01}));
  EXPECT_EQ(all.smallest(), 0.01);
  const CouplingTests two{.mean_p = 0.2, .nli_p = 0.3, .cubic_p = std::nullopt};
  EXPECT_DOUBLE_EQ(two.combined(), 0.87 * two.quadratic());
  EXPECT_EQ(two.smallest(), 0.2);
}

TEST(HosCouplingTests, NothingToEstimateFromSaysNothing) {
  std::vector<double> torn = tests::white_noise(1);
  for (std::size_t t = 0; t < torn.size(); t += 60) torn[t] = std::nan("");
  Bicoherence bicoherence(Settings{});
  const TestedSpectra tested(torn, bicoherence, Settings{});
  const CouplingTests found = test_coupling(tested, nullptr);
  EXPECT_EQ(found.mean_p, 1.0);
  EXPECT_EQ(found.smallest(), found.nli_p);
}

}  // namespace
}  // namespace loopscope::core::hos
