#include "core/model/residual_tests/tests/op_direction.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace loopscope::core::model {
namespace {

TEST(Play, StandsHalfAWidthBehind) {
  const std::vector<double> op = {0.0, 1.0, 4.0, 3.0, 2.0, 1.0};
  const std::vector<double> lag = lag_of_play(op, 2.0);
  EXPECT_EQ(lag, (std::vector<double>{0.0, -1.0, -1.0, 0.0, 1.0, 1.0}));
}

TEST(Play, StandsWhileOpIsMissing) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> lag = lag_of_play(std::vector{missing, 5.0, missing, 5.5}, 2.0);
  EXPECT_TRUE(std::isnan(lag[0]) && std::isnan(lag[2]));
  EXPECT_EQ(lag[1], 0.0);
  EXPECT_EQ(lag[3], -0.5);
}

}  // namespace
}  // namespace loopscope::core::model
