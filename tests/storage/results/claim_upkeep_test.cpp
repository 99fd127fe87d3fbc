#include <gtest/gtest.h>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

/// Claims beside the ordinary run of things: sources that are away, answers that were lost, clocks
/// that were wrong.
class ClaimUpkeepTest : public ResultsTest {};

TEST_F(ClaimUpkeepTest, LeavesOutSourcesThatAreAway) {
  add_loops({"a", "b", "c"});
  database->execute("UPDATE loopscope.loop SET source = 'other \"one\"' WHERE name = 'b'");
  ResultsDatabase results = connect();
  EXPECT_EQ(results.claim_due("me", 60, 10, {"plant", "nowhere"}).size(), 1U);
  EXPECT_EQ(results.claim_due("me", 60, 10, {"other \"one\""}).size(), 2U);
}

TEST_F(ClaimUpkeepTest, GivesBackWhatAnOwnerNeverHeardOf) {
  add_loops({"a", "b", "c"});
  ResultsDatabase results = connect();
  ASSERT_EQ(results.claim_due("me", 60, 2).size(), 2U);
  ASSERT_EQ(results.claim_due("other", 60, 2).size(), 1U);
  results.release_owned("me");
  EXPECT_EQ(value("SELECT string_agg(owner, ',') FROM loopscope.schedule"), "other");
  EXPECT_EQ(claim_all(results, 5).size(), 2U);
}

TEST_F(ClaimUpkeepTest, RecallsWhatAClockThatWasAheadHasPutOff) {
  add_loops({"a", "b", "c"});
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() + CASE loop_id % 3"
      " WHEN 0 THEN interval '1 day' WHEN 1 THEN interval '5 hours' ELSE interval '1 hour' END");
  ResultsDatabase results = connect();
  EXPECT_EQ(results.recall_stray(60), 1U);
  EXPECT_EQ(results.recall_stray(60), 0U);
  EXPECT_EQ(claim_all(results, 5).size(), 1U);
}

}  // namespace
}  // namespace loopscope::storage
