#include "core/hos/numeric/normal_draw.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

constexpr int kDraws = 20000;
using loopscope::tests::kInfinity;

struct MeanAndVariance {
  double mean = 0.0;
  double variance = 0.0;
};

template <typename Draw>
MeanAndVariance moments_of(Draw draw) {
  MeanAndVariance moments;
  for (int i = 0; i < kDraws; ++i) {
    const double value = draw();
    moments.mean += value / kDraws;
    moments.variance += value * value / kDraws;
  }
  moments.variance -= moments.mean * moments.mean;
  return moments;
}

/// Standard errors of 20 000 draws: 0.007 of the mean, 0.01 of the variance.
TEST(NormalDraw, HasMeanZeroAndVarianceOne) {
  std::mt19937_64 random(1);
  const MeanAndVariance found = moments_of([&] { return normal_draw(random); });
  EXPECT_NEAR(found.mean, 0.0, 0.03);
  EXPECT_NEAR(found.variance, 1.0, 0.04);
}

/// Mean of the normal law beyond x: density over tail.
TEST(NormalDraw, WithinLimitsFollowsTheLawBetweenThem) {
  for (const double low : {-1.0, 0.0, 2.0, 5.0}) {
    std::mt19937_64 random(1);
    const double tail = 0.5 * std::erfc(low / std::sqrt(2.0));
    const double expected = std::exp(-0.5 * low * low) / std::sqrt(2.0 * M_PI) / tail;
    const MeanAndVariance found =
        moments_of([&] { return normal_draw_within(0.0, 1.0, low, kInfinity, random); });
    EXPECT_NEAR(found.mean, expected, 0.03) << low;
  }
}

/// Mean of the normal law between two limits: difference of the densities over the share between.
TEST(NormalDraw, BetweenNearLimitsFollowsTheLawToo) {
  const auto density = [](double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * M_PI); };
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  for (const auto& limits : {std::pair{0.5, 1.2}, std::pair{-0.9, 0.1}, std::pair{3.0, 3.3},
                             std::pair{-2.5, -0.6}, std::pair{0.45, 1.4}}) {
    const double low = limits.first, high = limits.second;
    std::mt19937_64 random(1);
    const double expected = (density(low) - density(high)) / (below(high) - below(low));
    const MeanAndVariance found =
        moments_of([&] { return normal_draw_within(0.0, 1.0, low, high, random); });
    // Even draws would have the middle, 0.02 to 0.07 away.
    EXPECT_NEAR(found.mean, expected, 0.01) << low << " to " << high;
  }
}

/// Beyond x the law's variance is 1 + x h - h^2, h its mean there.
TEST(NormalDraw, InATailHasTheVarianceOfTheLawThere) {
  for (const double low : {0.6, 1.5, 4.0}) {
    std::mt19937_64 random(2);
    const double tail = 0.5 * std::erfc(low / std::sqrt(2.0));
    const double mean = std::exp(-0.5 * low * low) / std::sqrt(2.0 * M_PI) / tail;
    const double expected = 1.0 + low * mean - mean * mean;
    const MeanAndVariance found =
        moments_of([&] { return normal_draw_within(0.0, 1.0, low, kInfinity, random); });
    EXPECT_NEAR(found.variance, expected, 0.06 * expected) << low;
  }
}

TEST(NormalDraw, OfNoNumberIsNoNumber) {
  std::mt19937_64 random(1);
  EXPECT_TRUE(std::isnan(normal_draw_within(std::nan(""), 1.0, 0.0, 1.0, random)));
  EXPECT_TRUE(std::isnan(normal_draw_within(0.0, std::nan(""), 0.0, 1.0, random)));
}

TEST(NormalDraw, StaysWithinItsLimitsHoweverFarOut) {
  std::mt19937_64 random(1);
  for (const double off : {-1e300, -1e6, -30.0, 0.0, 30.0, 1e6, 1e300}) {
    for (int i = 0; i < 100; ++i) {
      const double value = normal_draw_within(0.0, 1.0, off, off + 0.1, random);
      EXPECT_GE(value, off);
      EXPECT_LE(value, off + 0.1);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::hos
