#include <gmock/gmock.h>
#include <pqxx/pqxx>
#include <set>
#include <thread>

#include "storage/results/results_database.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

class ClaimTest : public ResultsTest {};

std::set<std::int64_t> ids(const std::vector<ClaimedLoop>& claimed) {
  std::set<std::int64_t> result;
  for (const ClaimedLoop& claim : claimed) result.insert(claim.loop.loop_id);
  return result;
}

TEST_F(ClaimTest, BringsTheWholeCatalogueEntry) {
  CatalogueEntry entry = loop_named("FIC \"101\" 'a', {b}\\");
  entry.source = "unit 2";
  entry.sp_tag = "sp";
  entry.op_tag = "op";
  entry.mode_tag = "mode";
  entry.interval_s = 0.5;
  entry.period_s = 600.0;
  entry.op_range = core::signal::OpRange{4.0, 20.0};
  entry.loop_type = "flow";
  entry.importance = 2.5;
  Catalogue(settings_for(*database)).save(std::vector{entry});

  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);

  ASSERT_EQ(claimed.size(), 1u);
  const CatalogueEntry& loop = claimed[0].loop;
  EXPECT_GT(loop.loop_id, 0);
  EXPECT_EQ(loop.name, entry.name);
  EXPECT_EQ(loop.source, "unit 2");
  EXPECT_EQ(loop.sp_tag, "sp");
  EXPECT_EQ(loop.pv_tag, entry.pv_tag);
  EXPECT_EQ(loop.op_tag, "op");
  EXPECT_EQ(loop.mv_tag, "");
  EXPECT_EQ(loop.mode_tag, "mode");
  EXPECT_EQ(loop.interval_s, 0.5);
  EXPECT_EQ(loop.period_s, 600.0);
  ASSERT_TRUE(loop.op_range);
  EXPECT_EQ(loop.op_range->low, 4.0);
  EXPECT_EQ(loop.op_range->high, 20.0);
  EXPECT_EQ(loop.loop_type, "flow");
  EXPECT_EQ(loop.importance, 2.5);
  EXPECT_EQ(claimed[0].fence, 1);
  EXPECT_EQ(claimed[0].attempts, 0);
  EXPECT_EQ(claimed[0].last_slot_end_us, std::nullopt);
  EXPECT_FALSE(claimed[0].last_verdict);
  EXPECT_NEAR(static_cast<double>(claimed[0].database_now_us - loop.registered_us), 0.0, 60e6);
}

/// The newest slot's, as it was revised last, and not that of an older slot.
TEST_F(ClaimTest, BringsTheLastVerdict) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const auto finish = [&](int hour, const char* digest, core::diagnosis::VerdictCode code) {
    CompletedLoop loop = completed(claim_all(results).at(0), slot(hour), digest);
    loop.record->diagnosis.verdict.code = code;
    results.finish(std::vector{loop}, {});
    database->execute("UPDATE loopscope.schedule SET visible_at = now() - interval '1 second'");
  };
  using enum core::diagnosis::VerdictCode;
  finish(1, "d1", valve_stiction);
  finish(2, "d2", healthy);
  EXPECT_EQ(claim_all(results).at(0).last_verdict->code, healthy);
  database->execute("UPDATE loopscope.schedule SET visible_at = now() - interval '1 second'");
  finish(2, "d3", tight_tuning);
  const auto last = claim_all(results).at(0).last_verdict;
  ASSERT_TRUE(last);
  EXPECT_EQ(last->code, tight_tuning);
  EXPECT_EQ(last->confidence, 0.875);
  EXPECT_EQ(last->p, std::nullopt);
}

TEST_F(ClaimTest, TakesOnlyEnabledLoopsThatAreDue) {
  add_loops({"a", "b", "c"});
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"b"}, false);
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() + interval '1 hour'"
      " WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'c')");
  ResultsDatabase results = connect();
  EXPECT_EQ(results.count_enabled_loops(), 2u);
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  ASSERT_EQ(claimed.size(), 1u);
  EXPECT_EQ(claimed[0].loop.name, "a");
}

TEST_F(ClaimTest, TakesTheOldestFirst) {
  add_loops({"a", "b", "c"});
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() - loop_id * interval '1 minute'");
  ResultsDatabase results = connect();
  EXPECT_EQ(results.claim_due("w", 60, 1).at(0).loop.name, "c");
  EXPECT_EQ(results.claim_due("w", 60, 1).at(0).loop.name, "b");
}

TEST_F(ClaimTest, LeasedLoopIsNotClaimedUntilTheLeaseEnds) {
  add_loops({"a"});
  ResultsDatabase first = connect();
  ResultsDatabase second = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(first);
  EXPECT_TRUE(claim_all(second).empty());
  EXPECT_TRUE(second.claim_next("worker", 100, 10, 0).empty());

  database->execute(kEndLeases);
  const std::vector<ClaimedLoop> again = claim_all(second);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].fence, claimed[0].fence + 1);
  EXPECT_EQ(again[0].attempts, 1) << "a lost lease counts as a failure";
  EXPECT_THAT(value("SELECT last_error FROM loopscope.schedule"), HasSubstr("lease of worker"));
}

TEST_F(ClaimTest, ConcurrentClaimsNeverOverlap) {
  std::vector<std::string> names;
  for (int i = 0; i < 400; ++i) names.push_back("loop" + std::to_string(i));
  add_loops(names);

  std::vector<std::vector<ClaimedLoop>> claimed(4);
  {
    std::vector<std::jthread> workers;
    for (std::vector<ClaimedLoop>& mine : claimed) {
      workers.emplace_back([&mine, this] {
        ResultsDatabase results = connect();
        while (true) {
          const auto batch = results.claim_due("worker", 100, 7);
          if (batch.empty()) break;
          mine.insert(mine.end(), batch.begin(), batch.end());
        }
      });
    }
  }
  std::size_t total = 0;
  std::set<std::int64_t> all;
  for (const std::vector<ClaimedLoop>& mine : claimed) {
    total += mine.size();
    all.merge(ids(mine));
  }
  EXPECT_EQ(total, 400u);
  EXPECT_EQ(all.size(), 400u);
}

TEST_F(ClaimTest, NextWalksTheCatalogueOnceDueOrNot) {
  add_loops({"a", "b", "c", "d", "e"});
  database->execute("UPDATE loopscope.schedule SET visible_at = now() + interval '1 hour'");
  ResultsDatabase results = connect();
  std::vector<std::string> seen;
  std::int64_t after = 0;
  while (true) {
    const std::vector<ClaimedLoop> batch = results.claim_next("once", 100, 2, after);
    if (batch.empty()) break;
    for (const ClaimedLoop& claim : batch) seen.push_back(claim.loop.name);
    after = batch.back().loop.loop_id;
  }
  EXPECT_EQ(seen, (std::vector<std::string>{"a", "b", "c", "d", "e"}));
}

TEST_F(ClaimTest, ReleaseMakesDueAtOnce) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  results.release(claimed);
  const std::vector<ClaimedLoop> again = claim_all(results);
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(again[0].attempts, 0) << "giving back is no failure";
}

TEST_F(ClaimTest, ExtendNamesWhatOthersHave) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results, 5);
  database->execute("UPDATE loopscope.schedule SET fence = fence + 1 WHERE loop_id = " +
                    std::to_string(claimed[0].loop.loop_id));
  EXPECT_THAT(results.extend(claimed, 1000),
              testing::ElementsAre(ClaimKey{claimed[0].loop.loop_id, claimed[0].fence}));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule"
                  " WHERE visible_at > now() + interval '900 seconds'"),
            "1");
}

/// Its row is locked while it is given back: to wait for it could end in a deadlock.
TEST_F(ClaimTest, ExtendLeavesAloneWhatIsBeingGivenBack) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results, 5);
  pqxx::connection other(database->conninfo());
  pqxx::work finishing(other);
  finishing.exec("SELECT FROM loopscope.schedule WHERE loop_id = " +
                 std::to_string(claimed[0].loop.loop_id) + " FOR UPDATE");
  EXPECT_TRUE(results.extend(claimed, 1000).empty());
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule"
                  " WHERE visible_at > now() + interval '900 seconds'"),
            "1");
}

/// Claims all and lets the leases end, as a worker that dies does.
void die_with_all(ResultsDatabase& results, const tests::TestDatabase& database) {
  static_cast<void>(results.claim_due("worker", 100, 10));
  database.execute(kEndLeases);
}

TEST_F(ClaimTest, WhatWasLostTwiceInARowIsClaimedAlone) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  EXPECT_TRUE(results.claim_suspect("worker", 100).empty());
  die_with_all(results, *database);
  die_with_all(results, *database);
  EXPECT_EQ(claim_all(results).size(), 2u) << "twice may be chance: still together";
  database->execute(kEndLeases);
  EXPECT_TRUE(claim_all(results).empty()) << "a third time is not";
  EXPECT_EQ(results.claim_suspect("worker", 100).size(), 1u);
  EXPECT_EQ(results.claim_suspect("worker", 100).size(), 1u);
  EXPECT_TRUE(results.claim_suspect("worker", 100).empty());
}

TEST_F(ClaimTest, NextLeavesSuspectsOutHoweverItComesAcrossThem) {
  add_loops({"a", "b", "c"});
  ResultsDatabase results = connect();
  database->execute(
      "UPDATE loopscope.schedule SET owner = 'dead/1/0', lost_leases = 2, visible_at = now()"
      " WHERE loop_id = 1;"
      "UPDATE loopscope.schedule SET lost_leases = 3 WHERE loop_id = 2");
  EXPECT_THAT(ids(results.claim_next("once", 100, 10, 0)), testing::ElementsAre(3));
  EXPECT_EQ(results.claim_suspect("once", 100).size(), 1u);
}

TEST_F(ClaimTest, OneThatDiesAloneRestsLongerEachTime) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  for (int k = 0; k < 3; ++k) die_with_all(results, *database);
  for (const char* minutes : {"1", "2", "4", "8"}) {
    ASSERT_EQ(results.claim_suspect("worker", 100).size(), 1u);
    database->execute(kEndLeases);
    EXPECT_TRUE(results.claim_suspect("worker", 100).empty());
    EXPECT_EQ(value("SELECT round(extract(epoch FROM visible_at - now()) / 60) FROM"
                    " loopscope.schedule"),
              minutes);
    EXPECT_EQ(value("SELECT owner IS NULL FROM loopscope.schedule"), "t");
    database->execute(kEndLeases);
    EXPECT_TRUE(claim_all(results).empty()) << "it stays a suspect";
  }
  EXPECT_THAT(value("SELECT last_error FROM loopscope.schedule"), HasSubstr("alone"));
}

TEST_F(ClaimTest, OneThatDidNotKillItsWorkerIsCleared) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  for (int k = 0; k < 3; ++k) die_with_all(results, *database);
  const ClaimedLoop survived = results.claim_suspect("worker", 100).at(0);
  results.finish(std::vector{completed(survived, slot(1), "d")}, {});
  const ClaimedLoop failed = results.claim_suspect("worker", 100).at(0);
  results.finish({}, std::vector{FailedLoop{failed.loop.loop_id, failed.fence, "no", 1.0}});
  EXPECT_EQ(value("SELECT sum(lost_leases) FROM loopscope.schedule"), "0");
  database->execute(kEndLeases);
  EXPECT_EQ(claim_all(results).size(), 2u);
}

TEST_F(ClaimTest, TellsWhenTheNextLoopIsDue) {
  ResultsDatabase results = connect();
  EXPECT_EQ(results.next_due_in_s(100), std::nullopt);
  add_loops({"a", "b"});
  EXPECT_LE(results.next_due_in_s(100).value(), 0.0);
  static_cast<void>(claim_all(results, 60.0));
  EXPECT_NEAR(results.next_due_in_s(100).value(), 60.0, 5.0) << "when a lease ends";
}

TEST_F(ClaimTest, WorkersAreSeen) {
  ResultsDatabase results = connect();
  results.see_worker({"host/1", "0.1.0", 8, 32, 0});
  const std::string first = value("SELECT started_at FROM loopscope.worker");
  results.see_worker({"host/1", "0.1.0", 8, 16, 3});
  EXPECT_EQ(value("SELECT held_loops || ' ' || lost_leases FROM loopscope.worker"), "16 3");
  EXPECT_EQ(value("SELECT started_at FROM loopscope.worker"), first);
  EXPECT_EQ(value("SELECT last_seen > started_at FROM loopscope.worker"), "t");
}

}  // namespace
}  // namespace loopscope::storage
