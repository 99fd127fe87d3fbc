#include "core/simulate/limit_cycle.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/simulate/spectrum.hpp"

namespace loopscope::core::simulate {
namespace {

constexpr std::size_t kLongRecord = 65'536;

LimitCycle clean(WaveShape shape, double period, double jitter_rad) {
  return {.shape = shape, .period_samples = period, .snr_db = 200.0, .jitter_rad = jitter_rad};
}

TEST(LimitCycle, WavesHaveMeanZeroAndVarianceOne) {
  for (const auto shape : {WaveShape::sine, WaveShape::square, WaveShape::triangle,
                           WaveShape::sawtooth, WaveShape::asymmetric_square}) {
    // 61.7 does not divide the record: every place of the cycle is visited.
    const auto signal = limit_cycle(clean(shape, 61.7, 0.0), kLongRecord, 1);
    double mean = 0.0;
    for (const double sample : signal) mean += sample / kLongRecord;
    EXPECT_NEAR(mean, 0.0, 0.01) << name(shape);
    EXPECT_NEAR(tests::variance(signal), 1.0, 0.01) << name(shape);
  }
}

TEST(LimitCycle, NoiseHasTheRatioAskedFor) {
  LimitCycle cycle = clean(WaveShape::sine, 61.7, 0.0);
  cycle.snr_db = 0.0;
  EXPECT_NEAR(tests::variance(limit_cycle(cycle, kLongRecord, 2)), 2.0, 0.05);
  cycle.snr_db = 10.0;
  EXPECT_NEAR(tests::variance(limit_cycle(cycle, kLongRecord, 2)), 1.1, 0.02);
}

TEST(LimitCycle, HarmonicsAreThoseOfTheShape) {
  // 64 divides the segments of the estimate: harmonics fall on their bins.
  const auto harmonic = [](WaveShape shape, int order) {
    const auto signal = limit_cycle(clean(shape, 64.0, 0.0), kLongRecord, 3);
    return tests::power_at(signal, order / 64.0) / tests::power_at(signal, 1.0 / 64.0);
  };
  EXPECT_NEAR(harmonic(WaveShape::square, 3), 1.0 / 9.0, 0.01);
  EXPECT_NEAR(harmonic(WaveShape::triangle, 3), 1.0 / 81.0, 0.001);
  EXPECT_NEAR(harmonic(WaveShape::sawtooth, 2), 1.0 / 4.0, 0.01);
  EXPECT_LT(harmonic(WaveShape::square, 2), 1e-3);
  EXPECT_LT(harmonic(WaveShape::triangle, 2), 1e-3);
  EXPECT_LT(harmonic(WaveShape::sine, 2), 1e-6);
  EXPECT_GT(harmonic(WaveShape::asymmetric_square, 2), 0.1);
}

TEST(LimitCycle, PhaseWandersWithTheRootOfTheCycles) {
  // 0.1 sqrt(n) radians after n cycles. The sawtooth is the place in the cycle, so that the wander
  // is read off its first and last sample.
  constexpr int kSeeds = 400;
  double square = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto signal = limit_cycle(clean(WaveShape::sawtooth, 100.0, 0.1), 10'001,
                                    static_cast<std::uint64_t>(seed));
    // Slope: 2 sqrt(3) per cycle.
    const double moved = (signal.back() - signal.front()) / std::sqrt(12.0);
    const double cycles = moved - std::round(moved);
    square += cycles * cycles / kSeeds;
  }
  const double radians = 2.0 * std::acos(-1.0) * std::sqrt(square);
  EXPECT_NEAR(radians, 1.0, 0.15);  // four errors of a standard deviation of 400 numbers
}

TEST(LimitCycle, StartsAnywhereInTheCycle) {
  bool high = false;
  bool low = false;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double first = limit_cycle(clean(WaveShape::square, 64.0, 0.1), 1, seed).front();
    high = high || first > 0.0;
    low = low || first < 0.0;
  }
  EXPECT_TRUE(high && low);
}

}  // namespace
}  // namespace loopscope::core::simulate
