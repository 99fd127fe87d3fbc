#include <gtest/gtest.h>

#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/login_session.hpp"

namespace loopscope::storage {
namespace {

/// Claims beside the ordinary run of things: sources that are away, answers that were lost, clocks
/// that were wrong.
class ClaimUpkeepTest : public ResultsTest {};

constexpr const char* kCheck = "23514";  // SQLSTATE check_violation

TEST_F(ClaimUpkeepTest, LeavesOutSourcesThatAreAway) {
  add_loops({"a", "b", "c"});
  database->execute("UPDATE loopscope.loop SET source = 'other \"one\"' WHERE name = 'b'");
  ResultsDatabase results = connect();
  EXPECT_EQ(results.claim_due("me", 60, 10, {"plant", "nowhere"}).size(), 1U);
  EXPECT_EQ(results.claim_due("me", 60, 10, {"other \"one\""}).size(), 2U);
}

TEST_F(ClaimUpkeepTest, SharersLeaveTheirPartsToEachOther) {
  add_loops({"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m"});
  ResultsDatabase results = connect();
  const auto share = [&](int limit) { return results.claim_due("me", 60, limit, {}, 4).size(); };
  EXPECT_EQ(share(3), 3U) << "the limit";
  EXPECT_EQ(share(32), 3U) << "a quarter of ten";
  for (const std::size_t left : {7U, 5U, 3U}) EXPECT_EQ(share(32), 2U) << left << " are left";
  EXPECT_EQ(share(32), 1U);
  EXPECT_EQ(share(32), 0U);
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
  EXPECT_EQ(results.recall_stray(60), 2U) << "the period is an hour";
  EXPECT_EQ(results.recall_stray(60), 0U);
  EXPECT_EQ(claim_all(results, 5).size(), 2U);
}

TEST_F(ClaimUpkeepTest, APauseAfterFailuresIsNoStray) {
  add_loops({"a", "b", "c"});
  database->execute(
      "UPDATE loopscope.schedule SET last_error = 'no rows', attempts = 8 * (loop_id % 3),"
      " visible_at = now() + interval '4 hours'");
  ResultsDatabase results = connect();
  EXPECT_EQ(results.recall_stray(60), 1U) << "after one failure nobody waits for four hours";
  EXPECT_EQ(value("SELECT attempts FROM loopscope.schedule WHERE visible_at <= now()"), "0");
}

TEST_F(ClaimUpkeepTest, AClaimMadeUnderAClockAheadEndsInItsTime) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  ASSERT_EQ(results.claim_due("dead", 100, 1).size(), 1U);
  database->execute("UPDATE loopscope.schedule SET visible_at = visible_at + interval '30 days'");
  EXPECT_EQ(results.recall_stray(60), 2U);
  EXPECT_EQ(value("SELECT string_agg(round(extract(epoch FROM visible_at - now()) / 10)::text, ' '"
                  " ORDER BY owner) FROM loopscope.schedule"),
            "10 0")
      << "whoever lives prolongs it before";
  EXPECT_EQ(value("SELECT count(owner) FROM loopscope.schedule"), "1");
}

/// Of a clock ahead by less than the loop's period.
TEST_F(ClaimUpkeepTest, AClaimEndsInItsTimeHoweverLittleTheClockWasAhead) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  ASSERT_EQ(results.claim_due("dead", 100, 1).size(), 1U);
  EXPECT_EQ(results.recall_stray(60), 0U);
  database->execute("UPDATE loopscope.schedule SET visible_at = visible_at + interval '50 min'");
  EXPECT_EQ(results.recall_stray(60), 1U);
  EXPECT_EQ(value("SELECT visible_at <= now() + interval '100 s' FROM loopscope.schedule"), "t");
}

TEST_F(ClaimUpkeepTest, SlotsOfAClockAheadMakeWayForTheNewestStoredOne) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  for (const ClaimedLoop& claim : claim_all(results, 60))
    results.finish(std::vector{completed(claim, slot(1), "d1")}, {});
  database->execute(
      "UPDATE loopscope.schedule SET last_slot_end = now() + interval '30 days',"
      " result_slot_end = now() + interval '30 days' WHERE loop_id = 1");
  EXPECT_EQ(results.recall_stray(60), 1U);
  EXPECT_EQ(
      database->rows("SELECT DISTINCT last_slot_end, result_slot_end FROM loopscope.schedule"),
      (TextRows{{"2026-01-01 01:00:00+00", "2026-01-01 01:00:00+00"}}));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.latest_verdict"), "2");
}

TEST_F(ClaimUpkeepTest, ALoopRegisteredAtNoTimeStopsNoClaim) {
  add_loops({"a", "b", "c"});
  database->execute(
      "UPDATE loopscope.loop SET registered_at = CASE name WHEN 'a' THEN 'infinity'"
      " WHEN 'b' THEN '-infinity' ELSE '294276-12-31' END::timestamptz");
  ResultsDatabase results = connect();
  EXPECT_EQ(claim_all(results, 60).size(), 3U);
}

TEST_F(ClaimUpkeepTest, NoValueOfAWorkerStopsTheClaims) {
  database = database_of_owner();
  add_loops({"a", "b"});
  const std::string worker = database->make_login("loopscope_worker");
  ResultsDatabase results(settings_for(*database, worker));
  const tests::LoginSession thief(database->conninfo(worker));
  for (const char* const poison :
       {"fence = 9223372036854775807", "fence = 0 - 1", "fence = fence + 2",
        "attempts = 2147483647", "lost_leases = 2147483647", "last_slot_end = 'infinity'",
        "result_slot_end = '-infinity'", "result_slot_end = '294276-12-31'",
        "visible_at = 'infinity'", "hold_s = 1e300"}) {
    EXPECT_EQ(thief.state_of("UPDATE loopscope.schedule SET " + std::string(poison)), kCheck)
        << poison;
  }
  for (const char* const strange :
       {"visible_at = now(), attempts = 1000000, lost_leases = 1, owner = 'x'",
        "visible_at = now(), last_slot_end = '293999-12-31', result_slot_end = '293999-12-31'",
        "visible_at = now(), last_slot_end = '4713-01-01 BC', result_slot_end = '4713-01-01 BC'",
        "visible_at = '4713-01-01 BC'"}) {
    EXPECT_EQ(thief.state_of_bare("UPDATE loopscope.schedule SET " + std::string(strange)), "");
    EXPECT_EQ(claim_all(results, 60).size(), 2U) << strange;
    database->execute("UPDATE loopscope.schedule SET owner = NULL, lost_leases = 0");
  }
  EXPECT_EQ(thief.state_of_bare("UPDATE loopscope.schedule SET visible_at = '294276-12-31'"), "");
  EXPECT_EQ(results.claim_next("me", 60, 10, 0).size(), 2U) << "as once does";
}

}  // namespace
}  // namespace loopscope::storage
