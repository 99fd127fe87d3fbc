#include "core/hos/numeric/quantile.hpp"

#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace loopscope::core::hos {
namespace {

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
