#include "core/hos/surrogates/significance.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "core/hos/coupling/coupling_tests.hpp"
#include "core/hos/slow/period.hpp"
#include "core/hos/surrogates/surrogate_test.hpp"
#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/family_rates.hpp"
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
  return measure_significance(TestedRecord(signal).tested, Settings{}, seed);
}

/// What the first pass says.
CouplingTests first_pass(const std::vector<double>& signal) {
  const TestedRecord looked(signal);
  const HarmonicTest harmonics(dominant_period(looked.tested.signal()).value());
  return test_coupling(looked.tested, &harmonics);
}

TEST(HosSignificance, NormalNoiseHardlyEverNeedsTheSecondPass) {
  int asked = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto signal = tests::coloured(Innovation::gaussian, 0.9, seed);
    const Significance found = measure(signal);
    if (found.innovation) {
      ++asked;
    } else {
      EXPECT_EQ(found.nonlinear_p, first_pass(signal).combined()) << seed;
      EXPECT_EQ(found.surrogates, 0U);
    }
  }
  EXPECT_LE(asked, 8);
}

TEST(HosSignificance, PlantNoiseThatFoolsTheFirstPassGetsIt) {
  for (const Innovation law :
       {Innovation::exponential, Innovation::student_3, Innovation::bursts, Innovation::garch}) {
    int fooled = 0;
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto signal = tests::coloured(law, 0.9, seed);
      fooled += first_pass(signal).combined() < 1e-3 ? 1 : 0;
      held += measure(signal).nonlinear_p > 0.01 ? 1 : 0;
    }
    EXPECT_GE(fooled, 10) << name(law);
    EXPECT_GE(held, 18) << name(law);
  }
}

TEST(HosSignificance, NoTestOfCouplingSaysLessThanTheFirstPass) {
  for (const Innovation law : {Innovation::exponential, Innovation::bursts, Innovation::laplace}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const auto signal = tests::coloured(law, 0.9, seed);
      const Significance found = measure(signal);
      const CouplingTests first = first_pass(signal);
      EXPECT_EQ(found.ngi_p, first.mean_p);
      EXPECT_GE(found.nli_p, first.nli_p);
      EXPECT_GE(found.cubic_p.value(), first.cubic_p.value());
      EXPECT_GE(found.quadratic_p, first.quadratic());
    }
  }
}

TEST(HosSignificance, SeedsMatterInTheSecondPassOnly) {
  const auto skewed = tests::coloured(Innovation::exponential, 0.9, 1);
  EXPECT_EQ(measure(skewed, 5).nonlinear_p, measure(skewed, 5).nonlinear_p);
  bool differs = false;
  for (std::uint64_t seed = 6; seed <= 12; ++seed) {
    differs = differs || measure(skewed, 5).nonlinear_p != measure(skewed, seed).nonlinear_p;
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(measure(skewed, 5).ngi_p, measure(skewed, 6).ngi_p);
  const auto normal = tests::coloured(Innovation::gaussian, 0.9, 1);
  ASSERT_FALSE(measure(normal).innovation.has_value());
  EXPECT_EQ(measure(normal, 5).nonlinear_p, measure(normal, 6).nonlinear_p);
}

TEST(HosSignificance, DoesNotDependOnScale) {
  const auto skewed = tests::coloured(Innovation::exponential, 0.9, 2);
  const Significance before = measure(skewed);
  ASSERT_TRUE(before.innovation.has_value());
  for (const double gain : {0x1p990, 0x1p-990, 0x1p20}) {
    const Significance found = measure(tests::affine(skewed, gain, 0.0));
    EXPECT_TRUE(found.innovation.has_value()) << gain;
    EXPECT_EQ(found.nonlinear_p, before.nonlinear_p) << gain;
    EXPECT_EQ(found.nli_p, before.nli_p) << gain;
  }
}

/// No record takes more than forty surrogates of either kind.
TEST(HosSignificance, SurrogatesAreFew) {
  for (const auto* const name : {"sawtooth_64", "paper_5_4_kano", "white_exponential"}) {
    EXPECT_LE(measure(tests::family(name).draw(4096, 1)).surrogates, 2 * SurrogateP::kMost) << name;
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
