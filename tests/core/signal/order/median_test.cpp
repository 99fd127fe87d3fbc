#include "core/signal/order/median.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace loopscope::core::signal {
namespace {

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
