#include "core/model/valve_law/op_turns.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using tests::triangle;

TEST(OpTurns, FindsMaximaAndMinimaByTurns) {
  const std::vector<OpTurn> turns = find_op_turns(triangle(60, 10), 3.0);
  ASSERT_EQ(turns.size(), 5U);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    EXPECT_EQ(turns[i].sample, 10 * (i + 1));
    EXPECT_EQ(turns[i].direction, i % 2 == 0 ? 1.0 : -1.0);
    EXPECT_EQ(turns[i].op, i % 2 == 0 ? 10.0 : 0.0);
  }
}

TEST(OpTurns, SmallOnesAreNone) {
  EXPECT_TRUE(find_op_turns(triangle(60, 10), 11.0).empty());
  EXPECT_TRUE(find_op_turns({}, 1.0).empty());
}

TEST(OpTurns, AStickbandAboveTheTravelStandsBetweenTheTurns) {
  const std::vector<double> op = triangle(60, 10);
  const std::vector<OpTurn> turns = find_op_turns(op, 3.0);
  std::vector<EightNumbers> eight(op.size());
  run_from_every_turn({{ValveLaw::he, 14.0, 10.0}}, op, turns, eight);
  const std::vector<double> mv = series_at(0, eight);
  EXPECT_EQ(mv[12], 8.0);  // 10 - (S - J) / 2
  EXPECT_EQ(mv[19], 8.0);
  EXPECT_EQ(mv[25], 2.0);
}

TEST(OpTurns, WithoutAResetTheBandCounts) {
  const std::vector<double> op = triangle(60, 10);
  const std::vector<OpTurn> turns = find_op_turns(op, 3.0);
  std::vector<EightNumbers> eight(op.size());
  run_from_first_turn({{ValveLaw::he, 6.0, 6.0}}, op, turns, eight);
  const std::vector<double> mv = series_at(0, eight);
  EXPECT_EQ(mv[0], 10.0);   // stands where it is at the first turn
  EXPECT_EQ(mv[16], 10.0);  // 6 below the turn is not beyond the band
  EXPECT_EQ(mv[17], 3.0);
}

}  // namespace
}  // namespace loopscope::core::model
