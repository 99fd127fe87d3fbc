#include "core/loop/valve_work.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::loop {
namespace {

TEST(ValveWork, CountsTravelAndTurns) {
  const std::vector<double> op{10.0, 12.0, 11.0, 11.0, 14.0};
  const ValveWork work = measure_valve_work(op);
  EXPECT_DOUBLE_EQ(work.travel, 6.0);
  EXPECT_DOUBLE_EQ(work.reversals, 2.0);
  EXPECT_EQ(work.pairs, 4U);
}

TEST(ValveWork, RestIsNoReversal) {
  const std::vector<double> op{1.0, 2.0, 2.0, 3.0};
  EXPECT_DOUBLE_EQ(measure_valve_work(op).reversals, 0.0);
}

TEST(ValveWork, SinglePrecisionRoundingIsNoReversal) {
  std::vector<double> op;
  for (int k = 0; k < 100; ++k) op.push_back(50.0 + (k % 2 == 0 ? 4e-6 : 0.0));
  EXPECT_DOUBLE_EQ(measure_valve_work(op).reversals, 0.0);
}

TEST(ValveWork, OnlyPairsThatAreThereCount) {
  const double gap = std::nan("");
  const std::vector<double> op{1.0, 2.0, gap, 10.0, 9.0};
  const ValveWork work = measure_valve_work(op);
  EXPECT_DOUBLE_EQ(work.travel, 2.0);
  EXPECT_DOUBLE_EQ(work.reversals, 1.0);
  EXPECT_EQ(work.pairs, 2U);
}

}  // namespace
}  // namespace loopscope::core::loop
