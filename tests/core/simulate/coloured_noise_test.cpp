#include "core/simulate/coloured_noise.hpp"

#include <gtest/gtest.h>

#include "tests/core/simulate/spectrum.hpp"

namespace loopscope::core::simulate {
namespace {

TEST(ColouredNoise, RealPoleHasTheVarianceOfItsLaw) {
  // 1 / (1 - a^2); the samples of AR(1) 0.9 are worth about a tenth of as many independent ones.
  for (const auto law : {Innovation::gaussian, Innovation::laplace}) {
    const auto signal = coloured_noise(real_pole(0.9), law, 200'000, 1);
    EXPECT_NEAR(tests::variance(signal), 1.0 / 0.19, 0.3) << name(law);
  }
  EXPECT_EQ(coloured_noise(real_pole(0.0), Innovation::uniform, 10, 1).size(), 10U);
}

TEST(ColouredNoise, RandomWalkHasIndependentSteps) {
  const auto walk = coloured_noise(real_pole(1.0), Innovation::gaussian, 100'000, 2);
  std::vector<double> steps;
  for (std::size_t k = 1; k < walk.size(); ++k) {
    steps.push_back(walk[k] - walk[k - 1]);
  }
  EXPECT_NEAR(tests::variance(steps), 1.0, 0.02);
}

TEST(ColouredNoise, ResonanceSwingsWithItsPeriod) {
  for (const double period : {20.0, 200.0}) {
    const auto signal =
        coloured_noise(resonance(period, 0.99), Innovation::gaussian, 200 * 1024, 3);
    const double at_peak = tests::power_at(signal, 1.0 / period);
    EXPECT_GT(at_peak, 3.0 * tests::power_at(signal, 2.0 / period)) << period;
    EXPECT_GT(at_peak, tests::power_at(signal, 0.5 / period)) << period;
  }
}

TEST(ColouredNoise, StartsSettled) {
  // Variance over seeds is the same at the first and the last sample of a record.
  double first = 0.0;
  double last = 0.0;
  constexpr int kSeeds = 2000;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto signal = coloured_noise(resonance(200.0, 0.995), Innovation::gaussian, 300,
                                       static_cast<std::uint64_t>(seed));
    first += signal.front() * signal.front() / kSeeds;
    last += signal.back() * signal.back() / kSeeds;
  }
  EXPECT_NEAR(first / last, 1.0, 0.2);  // four errors of a ratio of two such variances
}

}  // namespace
}  // namespace loopscope::core::simulate
