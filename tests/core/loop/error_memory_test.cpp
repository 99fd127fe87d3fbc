#include "core/loop/error_memory.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace loopscope::core::loop {
namespace {

/// First-order autoregression of the given time constant in samples, with white noise on top.
std::vector<double> remembering(double samples, double noise_share, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double pole = std::exp(-1.0 / samples);
  const double scale = std::sqrt(1.0 - pole * pole);
  std::vector<double> series(4096);
  double state = normal(random);
  for (double& value : series) {
    value = state + std::sqrt(noise_share / (1.0 - noise_share)) * normal(random);
    state = pole * state + scale * normal(random);
  }
  return series;
}

double mean_memory(double samples, double noise_share) {
  constexpr std::uint64_t kSeeds = 20;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    sum += error_memory_samples(remembering(samples, noise_share, 900 + seed)).value();
  return sum / static_cast<double>(kSeeds);
}

/// An autoregression falls to 1/e of what it is at three samples after its time constant more; the
/// mean that a record of 4096 samples takes out costs long memories a little.
TEST(ErrorMemory, IsTheTimeConstantOfAnAutoregression) {
  EXPECT_NEAR(mean_memory(10.0, 0.0), 13.0, 1.5);
  EXPECT_NEAR(mean_memory(40.0, 0.0), 43.0, 6.0);
  EXPECT_NEAR(mean_memory(120.0, 0.0), 115.0, 25.0);
}

TEST(ErrorMemory, WhiteNoiseOnTopDoesNotShortenIt) {
  EXPECT_NEAR(mean_memory(40.0, 0.5), mean_memory(40.0, 0.0), 6.0);
}

TEST(ErrorMemory, GapsCountForNothing) {
  std::vector<double> series = remembering(40.0, 0.0, 7);
  const double whole = error_memory_samples(series).value();
  for (std::size_t k = 0; k < series.size(); k += 5)
    series[k] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(error_memory_samples(series).value(), whole, 3.0);
}

TEST(ErrorMemory, WhatRemembersNothingHasNone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> white(4096);
  for (double& value : white) value = normal(random);
  EXPECT_EQ(error_memory_samples(white), std::nullopt);
  EXPECT_EQ(error_memory_samples(std::vector<double>(4096, 1.0)), std::nullopt);
  EXPECT_EQ(error_memory_samples(std::vector<double>(8, 1.0)), std::nullopt);
  EXPECT_EQ(error_memory_samples({}), std::nullopt);
}

TEST(ErrorMemory, EndsAtAQuarterOfTheRecord) {
  std::vector<double> ramp(400);
  for (std::size_t k = 0; k < ramp.size(); ++k) ramp[k] = static_cast<double>(k);
  EXPECT_LE(error_memory_samples(ramp).value(), 101.0);
}

}  // namespace
}  // namespace loopscope::core::loop
