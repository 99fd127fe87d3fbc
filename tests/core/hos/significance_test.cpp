#include "core/hos/significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "core/hos/combine_p.hpp"
#include "core/hos/harmonic_test.hpp"
#include "core/hos/linear_model.hpp"
#include "core/hos/nli_p.hpp"
#include "core/hos/null_laws.hpp"
#include "core/hos/period.hpp"
#include "core/hos/quadratic_test.hpp"
#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

using simulate::Innovation;

/// A record with the spectra that are tested; holds what these point to.
struct TestedRecord {
  explicit TestedRecord(std::vector<double> record)
      : signal(std::move(record)),
        bicoherence(Settings{}),
        tested(signal, bicoherence, bicoherence.estimate(signal), Settings{}) {}

  std::vector<double> signal;
  Bicoherence bicoherence;
  TestedSpectra tested;
};

Significance measure(const std::vector<double>& signal, std::uint64_t seed = 1) {
  return measure_significance(TestedRecord(signal).tested, seed);
}

/// What the first pass says, from its parts.
Significance first_pass(const std::vector<double>& signal) {
  const TestedRecord looked(signal);
  const QuadraticTest test(looked.tested.settings());
  const auto found = test.measure(looked.tested.bicoherence(), looked.tested.bic2());
  const SegmentLevels* levels = looked.tested.levels() ? &*looked.tested.levels() : nullptr;
  const auto harmonics = harmonic_statistics(
      looked.tested.signal(), dominant_period(looked.tested.signal()).value(), levels);
  Significance result;
  result.ngi_p = test.mean_p(found, looked.tested.bicoherence().segments());
  result.nli_p = nli_p(test, found, harmonics);
  result.cubic_p = p_of_evidence(harmonics->cubic_evidence);
  result.quadratic_p = combine_p(std::array{result.ngi_p, result.nli_p});
  constexpr double kMeasuredOverNominal = 0.87;  // as in significance.cpp
  result.nonlinear_p =
      kMeasuredOverNominal * combine_p(std::array{result.ngi_p, result.nli_p, *result.cubic_p});
  return result;
}

TEST(HosSignificance, TheSecondPassRunsWhereItCanChangeSomething) {
  int clear = 0;
  int passes = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto signal = tests::coloured(Innovation::gaussian, 0.9, seed);
    const Significance found = measure(signal);
    const Significance first = first_pass(signal);
    const bool near = std::min({first.ngi_p, first.nli_p, *first.cubic_p}) < 0.05;
    const bool normal = LinearModel::fit(signal)->noise().core() == ResidualNoise::Core::gaussian;
    EXPECT_EQ(found.second_pass, near && !normal) << seed;
    clear += near ? 0 : 1;
    if (!found.second_pass) {
      EXPECT_EQ(found.nonlinear_p, first.nonlinear_p);
    }
  }
  EXPECT_GE(clear, 45);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    passes += measure(tests::coloured(Innovation::exponential, 0.9, seed)).second_pass ? 1 : 0;
  }
  EXPECT_EQ(passes, 10);
}

TEST(HosSignificance, NoPIsBelowTheFirstPass) {
  for (const Innovation law : {Innovation::exponential, Innovation::uniform, Innovation::laplace}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const auto signal = tests::coloured(law, 0.9, seed);
      const Significance found = measure(signal);
      const Significance first = first_pass(signal);
      EXPECT_EQ(found.ngi_p, first.ngi_p);
      EXPECT_GE(found.nli_p, first.nli_p);
      EXPECT_GE(found.cubic_p.value(), first.cubic_p.value());
      EXPECT_GE(found.quadratic_p, first.quadratic_p);
      EXPECT_GE(found.nonlinear_p, first.nonlinear_p);
    }
  }
}

TEST(HosSignificance, SeedsMatterInTheSecondPassOnly) {
  const auto skewed = tests::coloured(Innovation::exponential, 0.9, 1);
  EXPECT_EQ(measure(skewed, 5).nonlinear_p, measure(skewed, 5).nonlinear_p);
  EXPECT_NE(measure(skewed, 5).nonlinear_p, measure(skewed, 6).nonlinear_p);
  EXPECT_EQ(measure(skewed, 5).ngi_p, measure(skewed, 6).ngi_p);
  const auto normal = tests::coloured(Innovation::gaussian, 0.9, 1);
  ASSERT_FALSE(measure(normal).second_pass);
  EXPECT_EQ(measure(normal, 5).nonlinear_p, measure(normal, 6).nonlinear_p);
}

TEST(HosSignificance, DoesNotDependOnScale) {
  const auto skewed = tests::coloured(Innovation::exponential, 0.9, 2);
  const Significance before = measure(skewed);
  ASSERT_TRUE(before.second_pass);
  for (const double gain : {0x1p990, 0x1p-990, 0x1p20}) {
    const Significance found = measure(tests::affine(skewed, gain, 0.0));
    EXPECT_TRUE(found.second_pass) << gain;
    EXPECT_EQ(found.nonlinear_p, before.nonlinear_p) << gain;
    EXPECT_EQ(found.nli_p, before.nli_p) << gain;
  }
}

TEST(HosSignificance, FindsTheSquareWaveByItsThirdHarmonic) {
  const auto wave = simulate::limit_cycle({.period_samples = 30.0}, 4096, 1);
  const Significance found = measure(wave);
  EXPECT_NEAR(found.period_samples.value(), 30.0, 1.0);
  EXPECT_LT(found.cubic_p.value(), 1e-4);
  EXPECT_LT(found.nonlinear_p, 1e-3);
}

TEST(HosSignificance, WithoutSegmentsForTheCubicTestTheOthersDecide) {
  // Segments of 800 samples do not fit between gaps every 600, segments of 64 do.
  auto torn = simulate::limit_cycle({.period_samples = 400.0}, 4096, 1);
  for (std::size_t n = 0; n < torn.size(); n += 600) torn[n] = std::nan("");
  const Significance found = measure(torn);
  EXPECT_FALSE(found.cubic_p.has_value());
  EXPECT_FALSE(found.period_samples.has_value());
  EXPECT_DOUBLE_EQ(found.nonlinear_p, 0.87 * found.quadratic_p);
}

}  // namespace
}  // namespace loopscope::core::hos
