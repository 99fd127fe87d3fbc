#include "tests/effects/residual_tests.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::tests::effects {
namespace {

using testing::ContainsRegex;

TEST(ResidualTests, OfASensorThatHoldsTheClockIsSeen) {
  EXPECT_LE(p_of(answers_of("sensor_hold", 1, {}), "held"), 0.01);
  EXPECT_GT(p_of(answers_of("healthy_still", 1, {}), "held"), 0.01);
}

TEST(ResidualTests, TheTableHasALineForEachKind) {
  Plan plan;
  plan.kinds = {"healthy_still", "sensor_hold"};
  plan.draws = 2;
  const std::string table = passing_table(plan);
  EXPECT_THAT(table, ContainsRegex("kind .* held"));
  EXPECT_THAT(table, ContainsRegex("sensor_hold .* 100.0"));
  EXPECT_EQ(std::ranges::count(table, '\n'), 3);
}

}  // namespace
}  // namespace loopscope::tests::effects
