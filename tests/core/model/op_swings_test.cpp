#include "core/model/op_swings.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace loopscope::core::model {
namespace {

TEST(OpSwings, FindThePeriodOfASinusoid) {
  std::vector<double> op(4000);
  for (std::size_t k = 0; k < op.size(); ++k) {
    op[k] = 2.0 * std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / 50.0);
  }
  EXPECT_NEAR(swing_period(op, 1.0), 50.0, 1.0);
  EXPECT_NEAR(swing_period(op, 3.9), 50.0, 1.0);
  EXPECT_TRUE(std::isinf(swing_period(op, 4.1)));
}

TEST(OpSwings, NoneInAConstant) {
  EXPECT_TRUE(std::isinf(swing_period(std::vector<double>(10, 1.0), 0.0)));
  EXPECT_TRUE(std::isinf(swing_period({}, 1.0)));
}

}  // namespace
}  // namespace loopscope::core::model
