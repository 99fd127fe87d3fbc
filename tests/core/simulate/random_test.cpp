#include "core/simulate/random.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::simulate {
namespace {

TEST(GaussianSource, SameSeedSameNumbers) {
  GaussianSource first(7);
  GaussianSource second(7);
  GaussianSource other(8);
  bool differs = false;
  for (int i = 0; i < 1000; ++i) {
    const double number = first.next();
    EXPECT_EQ(number, second.next());
    differs = differs || number != other.next();
  }
  EXPECT_TRUE(differs);
}

TEST(GaussianSource, HasTheMomentsOfTheStandardNormal) {
  constexpr int kCount = 400000;
  GaussianSource source(1);
  double moments[5] = {};
  for (int i = 0; i < kCount; ++i) {
    const double number = source.next();
    double power = 1.0;
    for (double& moment : moments) {
      moment += power / kCount;
      power *= number;
    }
  }
  // Standard errors of the moments are sqrt(1, 2, 15, 96) / sqrt(n); five of them are allowed.
  const double error = 5.0 / std::sqrt(kCount);
  EXPECT_NEAR(moments[1], 0.0, error);
  EXPECT_NEAR(moments[2], 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(moments[3], 0.0, error * std::sqrt(15.0));
  EXPECT_NEAR(moments[4], 3.0, error * std::sqrt(96.0));
}

TEST(GaussianSource, NeighboursAreUncorrelated) {
  constexpr int kCount = 200000;
  GaussianSource source(2);
  double before = source.next();
  double product = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double number = source.next();
    product += number * before / kCount;
    before = number;
  }
  EXPECT_NEAR(product, 0.0, 5.0 / std::sqrt(kCount));
}

TEST(UniformSource, FillsTheOpenUnitIntervalEvenly) {
  UniformSource source(1);
  constexpr int kNumbers = 100'000;
  int tenths[10] = {};
  for (int i = 0; i < kNumbers; ++i) {
    const double number = source.next();
    ASSERT_GT(number, 0.0);
    ASSERT_LT(number, 1.0);
    ++tenths[static_cast<int>(10.0 * number)];
  }
  for (const int count : tenths) {
    EXPECT_NEAR(count, kNumbers / 10, 4 * 95);  // sqrt(100000 * 0.1 * 0.9) = 95
  }
}

TEST(UniformSource, IsTheEngineOfTheStandard) {
  // The 10000th number of a mt19937_64 with its default seed 5489 is 9981545732273789042.
  UniformSource source(5489);
  double last = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    last = source.next();
  }
  EXPECT_NEAR(last, 9981545732273789042.0 / 0x1.0p64, 1e-15);
}

}  // namespace
}  // namespace loopscope::core::simulate
