#include "core/signal/swinging_door.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/signal/archive.hpp"
#include "core/signal/gaps.hpp"
#include "core/signal/holes.hpp"

namespace loopscope::core::signal {
namespace {

Samples noise() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Samples samples;
  for (int k = 0; k < 2000; ++k) samples.push_back(normal(random));
  return samples;
}

TEST(SwingingDoor, NoSampleIsFartherFromTheLineThanTheBand) {
  const Samples samples = noise();
  for (const double band : {0.3, 1.0, 1.5}) {
    const Samples stored = swinging_door(samples, band);
    EXPECT_LT(count_recorded(stored), samples.size());
    const Reconstruction whole = reconstruct({stored, Archive::swinging_door, band});
    for (std::size_t k = 0; k < samples.size(); ++k) {
      EXPECT_NEAR(whole.value[k], samples[k], band + 1e-9);
    }
  }
}

TEST(SwingingDoor, StoresTheEndsOfALineAndOfEveryPiece) {
  Samples samples(100, 0.0);
  for (std::size_t k = 0; k < 100; ++k) samples[k] = 0.1 * static_cast<double>(k);
  samples[50] = kMissing;
  Samples expected(100, kMissing);
  for (const std::size_t k : {0U, 49U, 51U, 99U}) expected[k] = samples[k];
  const Samples stored = swinging_door(samples, 0.01);
  for (std::size_t k = 0; k < 100; ++k) {
    EXPECT_EQ(std::isfinite(stored[k]), std::isfinite(expected[k])) << k;
  }
}

}  // namespace
}  // namespace loopscope::core::signal
