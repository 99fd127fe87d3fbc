#include "core/model/record/move_direction.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using tests::triangle;

TEST(OpDirection, FollowsATriangleAFewStepsLate) {
  const tests::Series op = triangle(400, 50);
  const tests::Series direction = move_direction(op);
  EXPECT_EQ(direction[0], 0.0);
  for (std::size_t k = 1; k < 400; ++k) {
    const std::size_t phase = k % 100;
    if (phase > 5 && phase <= 50) {
      EXPECT_EQ(direction[k], 1.0) << k;
    }
    if (phase > 55) {
      EXPECT_EQ(direction[k], -1.0) << k;
    }
  }
}

TEST(OpDirection, RestsKeepTheLastMotion) {
  tests::Series op = triangle(101, 50);
  op.insert(op.end(), 200, op.back());
  EXPECT_EQ(move_direction(op).back(), -1.0);
}

TEST(OpDirection, NothingMovesNothing) {
  for (const double value : move_direction(tests::Series(50, 3.0))) EXPECT_EQ(value, 0.0);
  EXPECT_TRUE(move_direction({}).empty());
}

TEST(OpDirection, IsTheSameInAnyUnitAndTurnsWithTheSign) {
  tests::Series op = tests::white_noise(1000, 1);
  for (std::size_t k = 1; k < op.size(); ++k) op[k] += op[k - 1];
  const tests::Series direction = move_direction(op);
  EXPECT_EQ(move_direction(tests::scaled(op, 1024.0)), direction);
  EXPECT_EQ(move_direction(tests::scaled(op, -1.0)), tests::scaled(direction, -1.0));
}

TEST(OpDirection, NoiseBesideLargeMotionTurnsNothing) {
  tests::Series op(1000);
  const tests::Series noise = tests::white_noise(1000, 1, 0.2);
  for (std::size_t k = 0; k < 1000; ++k) op[k] = static_cast<double>(k) + noise[k];
  const tests::Series direction = move_direction(op);
  for (std::size_t k = 10; k < 1000; ++k) EXPECT_EQ(direction[k], 1.0) << k;
}

TEST(OpDirection, MissingSamplesHaveNotMoved) {
  tests::Series op = triangle(400, 50);
  for (std::size_t k = 20; k < 30; ++k) op[k] = std::numeric_limits<double>::quiet_NaN();
  const tests::Series direction = move_direction(op);
  for (std::size_t k = 20; k < 30; ++k) EXPECT_EQ(direction[k], direction[19]);
  op.front() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(move_direction(op)[40], 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
