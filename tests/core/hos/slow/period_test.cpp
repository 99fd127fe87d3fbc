#include "core/hos/slow/period.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

#include "core/simulate/limit_cycle.hpp"
#include "core/simulate/missing_samples.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

std::vector<double> wave(simulate::WaveShape shape, double period, std::uint64_t seed,
                         std::size_t samples = tests::kRecord) {
  return simulate::limit_cycle({.shape = shape, .period_samples = period, .jitter_rad = 0.02},
                               samples, seed);
}

TEST(HosPeriod, OfWavesWithinTwoPercent) {
  using simulate::WaveShape;
  for (const WaveShape shape :
       {WaveShape::sine, WaveShape::square, WaveShape::triangle, WaveShape::sawtooth}) {
    for (const double period : {8.5, 16.0, 23.7, 64.0, 130.0, 250.0, 400.0}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto found = dominant_period(wave(shape, period, seed));
        ASSERT_TRUE(found.has_value());
        EXPECT_NEAR(*found / period, 1.0, 0.02) << simulate::name(shape) << ' ' << period;
      }
    }
  }
}

TEST(HosPeriod, OfAnyRecordLiesInRange) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const double pole : {0.0, 0.9, 1.0}) {
      for (const std::size_t samples : {std::size_t{72}, std::size_t{300}, tests::kRecord}) {
        const auto found = dominant_period(tests::first_order_noise(seed, pole, samples));
        ASSERT_TRUE(found.has_value());
        EXPECT_GE(*found, kShortestPeriod);
        EXPECT_LE(*found, static_cast<double>(samples) / kFewestCycles);
      }
    }
  }
}

TEST(HosPeriod, SurvivesGaps) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto signal =
        simulate::with_gaps(wave(simulate::WaveShape::square, 64.0, seed), 0.4, 10, seed);
    EXPECT_NEAR(dominant_period(signal).value(), 64.0, 2.0);
  }
}

TEST(HosPeriod, InfinityIsMissingToo) {
  auto with_nan = wave(simulate::WaveShape::square, 64.0, 3);
  auto with_infinity = with_nan;
  for (std::size_t n = 100; n < 200; ++n) {
    with_nan[n] = std::nan("");
    with_infinity[n] = n % 2 == 0 ? std::numeric_limits<double>::infinity()
                                  : -std::numeric_limits<double>::infinity();
  }
  EXPECT_EQ(dominant_period(with_nan), dominant_period(with_infinity));
}

TEST(HosPeriod, DoesNotDependOnScaleOrOffset) {
  const auto signal = wave(simulate::WaveShape::triangle, 50.0, 4);
  const double before = dominant_period(signal).value();
  for (const double gain : {1e300, 1e-300, -1e6, 1e-6}) {
    const auto found = dominant_period(tests::affine(signal, gain, 0.0));
    ASSERT_TRUE(found.has_value()) << gain;
    EXPECT_NEAR(*found / before, 1.0, 1e-9) << gain;
  }
  EXPECT_NEAR(dominant_period(tests::affine(signal, 1.0, 1e6)).value() / before, 1.0, 1e-6);
}

TEST(HosPeriod, DriftIsNoPeriod) {
  auto signal = wave(simulate::WaveShape::sine, 50.0, 5);
  for (std::size_t n = 0; n < signal.size(); ++n) signal[n] += 0.01 * static_cast<double>(n);
  EXPECT_NEAR(dominant_period(signal).value(), 50.0, 1.0);
}

TEST(HosPeriod, NeedsNineCyclesOfTheShortestAndVariance) {
  EXPECT_FALSE(dominant_period({}).has_value());
  EXPECT_FALSE(dominant_period(tests::white_noise(1, 71)).has_value());
  EXPECT_TRUE(dominant_period(tests::white_noise(1, 72)).has_value());
  EXPECT_FALSE(dominant_period(std::vector<double>(4096, std::nan(""))).has_value());
  for (const double constant : {0.0, 1.0, 0.1, -1e300}) {
    EXPECT_FALSE(dominant_period(std::vector<double>(4096, constant)).has_value()) << constant;
  }
}

}  // namespace
}  // namespace loopscope::core::hos
