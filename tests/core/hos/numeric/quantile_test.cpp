#include "core/hos/numeric/quantile.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace loopscope::core::hos {
namespace {

// Solutions of erfc(z / sqrt 2) = 2 alpha in forty-digit arithmetic.
TEST(HosNormalQuantile, OfTheUsualLevels) {
  EXPECT_NEAR(upper_normal_quantile(0.5), 0.0, 1e-15);
  EXPECT_NEAR(upper_normal_quantile(0.05), 1.6448536269514727, 1e-15);
  EXPECT_NEAR(upper_normal_quantile(0.025), 1.959963984540054, 1e-15);
  EXPECT_NEAR(upper_normal_quantile(0.01), 2.3263478740408411, 1e-15);
  EXPECT_NEAR(upper_normal_quantile(0.0001), 3.7190164854556806, 2e-15);
}

TEST(HosNormalQuantile, InvertsTheTail) {
  for (double alpha = 0.5; alpha > 1e-300; alpha *= 0.7) {
    const double z = upper_normal_quantile(alpha);
    // The tail's relative error is z^2 times that of z: rounding of z alone gives 1e-13 at z = 37.
    EXPECT_NEAR(0.5 * std::erfc(z / std::numbers::sqrt2) / alpha, 1.0, 1e-12) << alpha;
  }
}

TEST(HosSampleQuantile, LiesBetweenOrderStatistics) {
  const std::vector<double> sorted = {1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_EQ(sample_quantile(sorted, 0.0), 1.0);
  EXPECT_EQ(sample_quantile(sorted, 0.25), 2.0);
  EXPECT_DOUBLE_EQ(sample_quantile(sorted, 0.1), 1.4);
  EXPECT_EQ(sample_quantile(sorted, 1.0), 5.0);
  EXPECT_EQ(sample_quantile(std::vector{7.0}, 0.3), 7.0);
  EXPECT_THROW((void)sample_quantile({}, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::hos
