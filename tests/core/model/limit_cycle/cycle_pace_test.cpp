#include "core/model/limit_cycle/cycle_pace.hpp"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "core/simulate/random.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kCycle = 40.0;

/// Half cycles of a sine, each of its own height, and as long as its height to this power says.
std::vector<double> half_cycles(double power, std::size_t count) {
  simulate::GaussianSource normal(5);
  std::vector<double> signal;
  for (std::size_t i = 0; i < count; ++i) {
    const double height = std::exp(0.25 * normal.next());
    const auto length = static_cast<std::size_t>(0.5 * kCycle * std::pow(height, power));
    for (std::size_t k = 0; k < length; ++k) {
      const double angle =
          std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(length);
      signal.push_back((i % 2 == 0 ? 1.0 : -1.0) * height * std::sin(angle));
    }
  }
  return signal;
}

TEST(CyclePace, TheLargerTheSoonerOver) {
  EXPECT_LT(pace_by_size(half_cycles(-1.0, 80), kCycle).value(), -0.5);
}

TEST(CyclePace, TheLargerTheLonger) {
  EXPECT_GT(pace_by_size(half_cycles(1.0, 80), kCycle).value(), 0.5);
}

TEST(CyclePace, AWaveThatFadesKeepsItsPace) {
  EXPECT_NEAR(pace_by_size(half_cycles(0.0, 80), kCycle).value(), 0.0, 0.2);
}

/// Over 200 records of noise: half cycles of noise in a band grow with their length.
TEST(CyclePace, OfNoiseIsPositive) {
  int positive = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    simulate::GaussianSource normal(seed);
    std::vector<double> noise(1000);
    for (double& value : noise) value = normal.next();
    positive += pace_by_size(noise, 12.0).value() > 0.0 ? 1 : 0;
  }
  EXPECT_GE(positive, 195);
}

TEST(CyclePace, FewHalfCyclesSayLittle) {
  EXPECT_GT(pace_by_size(half_cycles(-1.0, 8), kCycle).value(),
            pace_by_size(half_cycles(-1.0, 80), kCycle).value());
  EXPECT_FALSE(pace_by_size(half_cycles(-1.0, 5), kCycle).has_value());
}

TEST(CyclePace, NothingOfAStandstill) {
  EXPECT_FALSE(pace_by_size(std::vector<double>(1000, 0.0), kCycle).has_value());
}

}  // namespace
}  // namespace loopscope::core::model
