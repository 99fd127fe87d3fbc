#include "core/hos/replicates.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "core/simulate/coloured_noise.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

Replicates drawn_from(const std::vector<double>& record, std::uint64_t seed,
                      std::optional<double> period = 30.0) {
  Bicoherence bicoherence(Settings{});
  const auto bic2 = bicoherence.estimate(record);
  const TestedSpectra tested(record, bicoherence, bic2, Settings{});
  const QuadraticTest test(tested.settings());
  return {LinearModel::fit(record).value(), tested, test, period, seed};
}

double mean_of(const std::vector<double>& record) {
  Bicoherence bicoherence(Settings{});
  const auto bic2 = bicoherence.estimate(record);
  return QuadraticTest(Settings{}).measure(bicoherence, bic2).mean;
}

TEST(HosReplicates, TheSameSeedGivesTheSameFigures) {
  const auto record = tests::coloured(simulate::Innovation::exponential, 0.8, 1);
  const Replicates one = drawn_from(record, 7);
  const Replicates same = drawn_from(record, 7);
  const Replicates other = drawn_from(record, 8);
  const double mean = mean_of(record);
  EXPECT_EQ(one.mean_p(mean), same.mean_p(mean));
  EXPECT_EQ(one.nli_p(1e-3), same.nli_p(1e-3));
  EXPECT_EQ(one.cubic_p(1e-3), same.cubic_p(1e-3));
  EXPECT_NE(one.mean_p(mean), other.mean_p(mean));
}

TEST(HosReplicates, OfNormalNoiseLeaveTheFirstPassAsItIs) {
  // A mean of sixty exponential values exceeds its limit by chance: 8 of 100 records stretch the
  // cubic p, none the other.
  constexpr int kRecords = 30;
  int unchanged = 0;
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    const Replicates drawn =
        drawn_from(tests::coloured(simulate::Innovation::gaussian, 0.8, seed), seed);
    EXPECT_NEAR(drawn.mean_p(1.01), 0.5, 0.35);
    EXPECT_LT(drawn.mean_p(2.0), 1e-3);
    unchanged += drawn.nli_p(1e-3) == 1e-3 && drawn.cubic_p(1e-3) == 1e-3 ? 1 : 0;
  }
  EXPECT_GE(unchanged, (0.92 - four_errors(0.08, kRecords)) * kRecords);
}

TEST(HosReplicates, OfSkewedNoiseExpectItsBicoherence) {
  // Exponential noise has a squared bicoherence everywhere: what is far out for normal noise is
  // usual for it.
  const auto record = tests::coloured(simulate::Innovation::exponential, 0.8, 3);
  const double mean = mean_of(record);
  ASSERT_LT(QuadraticTest(Settings{}).mean_p({mean, 0.0}, 127), 1e-10);
  EXPECT_GT(drawn_from(record, 3).mean_p(mean), 1e-3);
}

TEST(HosReplicates, NeverLowerWhatTheFirstPassFound) {
  for (const auto law : {simulate::Innovation::laplace, simulate::Innovation::exponential}) {
    const Replicates drawn = drawn_from(tests::coloured(law, 0.8, 4), 4);
    double before = 0.0;
    for (double p = 1e-300; p <= 1.0; p *= 10.0) {
      EXPECT_GE(drawn.nli_p(p), p);
      EXPECT_GE(drawn.cubic_p(p), p);
      EXPECT_LE(drawn.cubic_p(p), 1.0);
      EXPECT_GE(drawn.nli_p(p), before);
      before = drawn.nli_p(p);
    }
    EXPECT_GE(drawn.mean_p(1.5), drawn.mean_p(2.5));
  }
}

TEST(HosReplicates, WithoutAPeriodTheCubicPStays) {
  const Replicates drawn =
      drawn_from(tests::coloured(simulate::Innovation::laplace, 0.8, 5), 5, std::nullopt);
  EXPECT_EQ(drawn.cubic_p(1e-3), 1e-3);
}

TEST(HosReplicates, WithoutASegmentSayNothing) {
  auto torn = tests::coloured(simulate::Innovation::exponential, 0.8, 6);
  for (std::size_t n = 0; n < torn.size(); n += 60) torn[n] = std::nan("");
  const Replicates drawn = drawn_from(torn, 6, std::nullopt);
  EXPECT_EQ(drawn.mean_p(5.0), 1.0);
  EXPECT_EQ(drawn.nli_p(0.3), 0.3);
}

}  // namespace
}  // namespace loopscope::core::hos
