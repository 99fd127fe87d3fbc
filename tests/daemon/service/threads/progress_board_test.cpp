#include "daemon/service/threads/progress_board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;
using Clock = ProgressBoard::Clock;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<storage::ClaimedLoop> claims(const std::vector<std::int64_t>& loop_ids) {
  std::vector<storage::ClaimedLoop> claims;
  for (const std::int64_t loop_id : loop_ids) claims.emplace_back().loop.loop_id = loop_id;
  return claims;
}

std::vector<storage::ClaimKey> keys(std::initializer_list<storage::ClaimKey> keys) {
  return keys;
}

std::vector<std::int64_t> proven(ProgressBoard& board) {
  std::vector<std::int64_t> loop_ids;
  for (const auto& claim : board.proven_claims()) loop_ids.push_back(claim.loop.loop_id);
  return loop_ids;
}

TEST(ProgressBoard, OnlyWhoGotOnSinceKeepsItsClaims) {
  ProgressBoard board;
  ProgressBoard::Entry& busy = board.entry();
  ProgressBoard::Entry& hanging = board.entry();
  busy.hold(claims({1, 2}));
  hanging.hold(claims({3}));
  EXPECT_THAT(proven(board), UnorderedElementsAre(1, 2, 3)) << "all are new";
  board.renewed(Clock::now());
  EXPECT_THAT(proven(board), IsEmpty());
  busy.step();
  EXPECT_THAT(proven(board), ElementsAre(1, 2));
  EXPECT_THAT(proven(board), ElementsAre(1, 2)) << "until they are renewed";
  busy.drop();
  EXPECT_THAT(proven(board), IsEmpty());
}

TEST(ProgressBoard, AStepDuringTheRenewalCountsForTheNext) {
  ProgressBoard board;
  ProgressBoard::Entry& progress = board.entry();
  progress.hold(claims({1}));
  const Clock::time_point seen = Clock::now();
  progress.step();
  board.renewed(seen);
  EXPECT_THAT(proven(board), ElementsAre(1));
}

TEST(ProgressBoard, WhoWaitsForACoreGetsOnAsLongAsAnybodyDoes) {
  ProgressBoard board;
  ProgressBoard::Entry& waiting = board.entry();
  ProgressBoard::Entry& busy = board.entry();
  waiting.hold(claims({1}));
  busy.hold(claims({2}));
  const ProgressBoard::Entry::Wait wait(waiting);
  board.renewed(Clock::now());
  EXPECT_THAT(proven(board), IsEmpty());
  busy.step();
  EXPECT_THAT(proven(board), UnorderedElementsAre(1, 2));
}

TEST(ProgressBoard, WhatIsLostIsToldAndNotAskedForAgain) {
  ProgressBoard board;
  ProgressBoard::Entry& progress = board.entry();
  progress.hold(claims({1, 2}));
  EXPECT_EQ(board.lose(keys({{2, 0}, {7, 0}})), 1u);
  EXPECT_EQ(board.lose(keys({{2, 0}})), 0u);
  EXPECT_TRUE(progress.lost(2));
  EXPECT_FALSE(progress.lost(1));
  EXPECT_THAT(proven(board), ElementsAre(1));
  progress.hold(claims({2}));
  EXPECT_FALSE(progress.lost(2)) << "claimed anew";
}

TEST(ProgressBoard, AnOutdatedClaimSaysNothingOfANewOne) {
  ProgressBoard board;
  ProgressBoard::Entry& former = board.entry();
  ProgressBoard::Entry& present = board.entry();
  auto claimed = claims({1});
  claimed[0].fence = 7;
  former.hold(claimed);
  claimed[0].fence = 8;
  present.hold(claimed);
  EXPECT_EQ(board.lose(keys({{1, 7}})), 1u);
  EXPECT_TRUE(former.lost(1));
  EXPECT_FALSE(present.lost(1));
}

TEST(ProgressBoard, WhatIsGivenBackIsHeldNoLonger) {
  ProgressBoard board;
  ProgressBoard::Entry& progress = board.entry();
  progress.hold(claims({1, 2, 3}));
  progress.done(std::vector<std::int64_t>{2});
  EXPECT_THAT(proven(board), ElementsAre(1, 3));
  board.lose(keys({{3, 0}}));
  ASSERT_EQ(progress.held().size(), 1u);
  EXPECT_EQ(progress.held()[0].loop.loop_id, 1);
}

TEST(ProgressBoard, AnIdleLaneProvesNothingForThoseThatWait) {
  ProgressBoard board;
  ProgressBoard::Entry& waiting = board.entry();
  ProgressBoard::Entry& hanging = board.entry();
  ProgressBoard::Entry& idle = board.entry();
  waiting.hold(claims({1}));
  hanging.hold(claims({2}));
  const ProgressBoard::Entry::Wait wait(waiting);
  board.renewed(Clock::now());
  idle.step();
  EXPECT_THAT(proven(board), IsEmpty());
}

TEST(ProgressBoard, SaysWhenABatchStandsStill) {
  ProgressBoard board;
  ProgressBoard::Entry& progress = board.entry();
  const Clock::time_point later = Clock::now() + 100s;
  EXPECT_FALSE(board.standstill(60s, later)) << "an idle worker has nothing to show";
  progress.hold(claims({1}));
  EXPECT_FALSE(board.standstill(120s, later));
  EXPECT_THAT(board.standstill(60s, later).value_or(""),
              testing::StartsWith("a batch of loops has made no progress for"));
  {
    const ProgressBoard::Entry::Wait wait(progress);
    EXPECT_FALSE(board.standstill(60s, later)) << "whoever has the core answers for it";
  }
  EXPECT_EQ(board.held_loops(), 1u);
}

}  // namespace
}  // namespace loopscope::daemon
