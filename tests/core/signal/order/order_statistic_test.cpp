#include "core/signal/order/order_statistic.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

#include "tests/core/signal/mixed_values.hpp"

namespace loopscope::core::signal {
namespace {

TEST(OrderStatistic, IsTheValueAtItsRank) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const std::size_t count : {1U, 2U, 99U, 100U, 101U, 1000U, 4096U}) {
      const std::vector<double> values = mixed_values(count, seed);
      std::vector<double> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (const std::size_t rank : {std::size_t{0}, count / 20, count / 2, count - 1}) {
        ASSERT_EQ(order_statistic(values, rank), sorted[rank]) << count << " of seed " << seed;
      }
    }
  }
}

TEST(OrderStatistic, OfEqualValuesAndOfInfiniteOnes) {
  std::vector<double> values(500, 3.0);
  EXPECT_EQ(order_statistic(values, 250), 3.0);
  values[4] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(order_statistic(values, 250), 3.0);
  EXPECT_EQ(order_statistic(values, 499), std::numeric_limits<double>::infinity());
}

TEST(Median, IsTheMiddleWhateverTheOrder) {
  EXPECT_EQ(median(std::vector<double>{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median(std::vector<double>{7.0}), 7.0);
  EXPECT_EQ(median(std::vector<double>{4.0, 1.0, 3.0, 2.0}), 3.0);
}

TEST(Median, DeviationGivesTheSpreadOfGaussianValues) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0.0, 2.0);
  std::vector<double> distances(100000);
  for (double& d : distances) d = std::abs(normal(random));
  EXPECT_NEAR(kMadToSigma * median(distances), 2.0, 0.03);
}

}  // namespace
}  // namespace loopscope::core::signal
