#include "core/signal/order/spread.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/support/numbers.hpp"

namespace loopscope::core::signal {
namespace {

using loopscope::tests::kNaN;

TEST(Spread, OfKnownValues) {
  const auto spread = measure_spread(std::vector{2.0, kNaN, 4.0, 6.0});
  EXPECT_DOUBLE_EQ(spread->mean, 4.0);
  EXPECT_NEAR(spread->std, std::sqrt(8.0 / 3.0), 1e-12);
  EXPECT_EQ(spread->low, 2.0);
  EXPECT_EQ(spread->high, 6.0);
  EXPECT_FALSE(measure_spread(std::vector{kNaN}).has_value());
}

TEST(Spread, HugeValuesDoNotOverflow) {
  const auto spread = measure_spread(std::vector{1e308, -1e308, 1e308, -1e308});
  EXPECT_TRUE(std::isfinite(spread->mean));
  EXPECT_NEAR(spread->std / 1e308, 1.0, 1e-9);
}

TEST(Spread, ConstantMeansUpToRounding) {
  EXPECT_TRUE(measure_spread(std::vector{0.1 + 0.2, 0.3})->constant());
  EXPECT_TRUE(measure_spread(std::vector{0.0, 0.0})->constant());
  EXPECT_FALSE(measure_spread(std::vector{1e-300, 2e-300})->constant());
}

TEST(SmallestStep, IsTheGridOfAQuantisedSignal) {
  EXPECT_DOUBLE_EQ(*smallest_step(std::vector{1.0, 1.75, 1.25, 1.25, 3.0}), 0.25);
  EXPECT_FALSE(smallest_step(std::vector{5.0, 5.0, kNaN}).has_value());
}

TEST(LongestFlatRun, IsBrokenByAGap) {
  EXPECT_EQ(longest_flat_run(std::vector{1.0, 1.0, kNaN, 1.0, 1.0, 1.0, 2.0}), 3U);
  EXPECT_EQ(longest_flat_run(std::vector<double>{}), 0U);
}

}  // namespace
}  // namespace loopscope::core::signal
