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

TEST(OpSwings, TurnsAloneKeepThePeriodOfWiderSwings) {
  std::vector<double> op(4000);
  unsigned state = 1;
  double level = 0.0;
  for (std::size_t k = 0; k < op.size(); ++k) {
    state = state * 1664525U + 1013904223U;
    level = 0.95 * level + static_cast<double>(state >> 16) / 65536.0 - 0.5;
    op[k] = level + 2.0 * std::sin(0.05 * static_cast<double>(k));
  }
  const OpSwings swings(op, 0.2);
  for (double swing = 0.2; swing < 8.0; swing *= 1.1) {
    EXPECT_EQ(swings.period(swing), swing_period(op, swing)) << swing;
  }
  EXPECT_TRUE(std::isinf(OpSwings({}, 0.1).period(1.0)));
}

}  // namespace
}  // namespace loopscope::core::model
