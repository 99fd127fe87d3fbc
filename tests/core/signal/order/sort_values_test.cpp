#include "core/signal/order/sort_values.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "tests/core/signal/mixed_values.hpp"

namespace loopscope::core::signal {
namespace {

TEST(SortValues, IsWhatComparisonsGive) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const std::size_t count : {0U, 1U, 2U, 199U, 200U, 201U, 1000U, 4096U, 65537U}) {
      std::vector<double> values = mixed_values(count, seed);
      std::vector<double> expected = values;
      std::sort(expected.begin(), expected.end());
      sort_values(values);
      ASSERT_EQ(values, expected) << count << " values of seed " << seed;
    }
  }
}

TEST(SortValues, PutsEvenlySpreadValuesAndBothZerosInOrder) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::size_t count : {200U, 4096U, 50'000U}) {
    std::vector<double> values(count);
    std::ranges::generate(values, [&] { return uniform(random); });
    values[3] = 0.0;
    values[5] = -0.0;
    std::vector<double> expected = values;
    std::ranges::sort(expected);
    sort_values(values);
    ASSERT_EQ(values, expected);
    const auto zero = std::ranges::find(values, 0.0);
    EXPECT_TRUE(std::signbit(zero[0]));
    EXPECT_FALSE(std::signbit(zero[1]));
  }
}

TEST(SortValues, KnowsInfinityAndBothZeros) {
  std::vector<double> values(300, 1.0);
  values[7] = std::numeric_limits<double>::infinity();
  values[8] = -std::numeric_limits<double>::infinity();
  values[9] = -0.0;
  values[10] = 0.0;
  sort_values(values);
  EXPECT_EQ(values.front(), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(values.back(), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::signbit(values[1]));
  EXPECT_FALSE(std::signbit(values[2]));
  EXPECT_EQ(values[2], 0.0);
}

}  // namespace
}  // namespace loopscope::core::signal
