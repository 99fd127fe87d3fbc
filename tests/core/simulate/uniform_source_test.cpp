#include "core/simulate/uniform_source.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::simulate {
namespace {

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
