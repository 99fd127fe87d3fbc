#include "core/signal/setpoint_moves.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::signal {
namespace {

std::vector<SetpointMove> moves_of(const Samples& sp, const std::vector<ControlMode>& mode = {}) {
  PreparedLoop loop;
  loop.sp = sp;
  loop.mode = mode;
  return find_setpoint_moves(loop);
}

TEST(SetpointMoves, ARestingSetpointHasNone) {
  EXPECT_TRUE(moves_of({}).empty());
  EXPECT_TRUE(moves_of({5.0, 5.0, 5.0}).empty());
  EXPECT_TRUE(moves_of({kMissing, 5.0, kMissing}).empty());
}

TEST(SetpointMoves, SamplesInARowAndOneDirectionAreOneMove) {
  const auto moves = moves_of({1.0, 2.0, 4.0, 4.0, 3.0, 5.0});
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[0].first, 1U);
  EXPECT_EQ(moves[0].last, 2U);
  EXPECT_EQ(moves[0].size, 3.0);
  EXPECT_EQ(moves[1].size, -1.0);
  EXPECT_EQ(moves[2].size, 2.0);
}

TEST(SetpointMoves, AMoveDuringAGapCountsAfterIt) {
  const auto moves = moves_of({1.0, kMissing, kMissing, 4.0, 4.0});
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_EQ(moves[0].first, 3U);
  EXPECT_EQ(moves[0].size, 3.0);
}

TEST(SetpointMoves, ManualHidesItsMovesAndEndsWithOneOfUnknownSize) {
  constexpr auto kAutomatic = ControlMode::automatic;
  constexpr auto kManual = ControlMode::manual;
  const auto moves = moves_of({1.0, 2.0, 3.0, 4.0, 4.0, 6.0},
                              {kAutomatic, kManual, kManual, kAutomatic, kAutomatic, kAutomatic});
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].first, 3U);
  EXPECT_EQ(moves[0].size, kUnknownSize);
  EXPECT_EQ(moves[1].size, 2.0);
}

TEST(SetpointMoves, OfASetpointAloneNothingIsManual) {
  const auto moves = find_setpoint_moves(std::vector{1.0, 2.0, kMissing, 2.0, 1.0});
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].first, 1U);
  EXPECT_EQ(moves[1].size, -1.0);
}

}  // namespace
}  // namespace loopscope::core::signal
