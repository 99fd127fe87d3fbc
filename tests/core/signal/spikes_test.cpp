#include "core/signal/spikes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace loopscope::core::signal {
namespace {

Samples noise(std::uint64_t seed, double pole = 0.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Samples samples(4096);
  double state = 0.0;
  for (double& v : samples) v = state = pole * state + normal(random);
  return samples;
}

TEST(Spikes, AnIsolatedOutlierBecomesMissing) {
  Samples samples = noise(1);
  samples[1000] = 15.0;
  samples[2000] = -15.0;
  EXPECT_EQ(discard_spikes(samples), 2U);
  EXPECT_TRUE(std::isnan(samples[1000]) && std::isnan(samples[2000]));
}

TEST(Spikes, GaussianNoiseIsLeftAlone) {
  for (const double pole : {0.0, 0.9, 0.99, 1.0}) {
    std::size_t found = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      Samples samples = noise(seed, pole);
      found += discard_spikes(samples);
    }
    EXPECT_EQ(found, 0U) << pole;
  }
}

TEST(Spikes, StepsAndLimitCyclesAreLeftAlone) {
  Samples step = noise(2);
  for (std::size_t k = 2000; k < step.size(); ++k) step[k] += 50.0;
  EXPECT_EQ(discard_spikes(step), 0U);
  Samples square = noise(3);
  for (std::size_t k = 0; k < square.size(); ++k) square[k] += k / 25 % 2 == 0 ? 30.0 : -30.0;
  EXPECT_EQ(discard_spikes(square), 0U);
  Samples held(4096);
  for (std::size_t k = 0; k < held.size(); ++k) held[k] = static_cast<double>(k / 12 % 7);
  EXPECT_EQ(discard_spikes(held), 0U);
}

TEST(Spikes, ASignalFullOfOutliersIsHowItIs) {
  Samples samples = noise(4);
  for (std::size_t k = 0; k < samples.size(); k += 50) samples[k] = 100.0;
  EXPECT_EQ(discard_spikes(samples), 0U);
}

TEST(Spikes, ConstantEmptyAndBrokenSignals) {
  Samples constant(100, 5.0);
  EXPECT_EQ(discard_spikes(constant), 0U);
  Samples empty;
  EXPECT_EQ(discard_spikes(empty), 0U);
  Samples missing(100, kMissing);
  EXPECT_EQ(discard_spikes(missing), 0U);
}

}  // namespace
}  // namespace loopscope::core::signal
