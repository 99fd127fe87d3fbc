#include <gmock/gmock.h>
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

/// Lets every lease end now, as if its time had passed.
constexpr const char* kEndLeases =
    "UPDATE loopscope.schedule SET visible_at = now() - interval '1 second'";

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

TEST_F(ClaimTest, ExtendCountsWhatIsStillHeld) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results, 5);
  database->execute("UPDATE loopscope.schedule SET fence = fence + 1 WHERE loop_id = " +
                    std::to_string(claimed[0].loop.loop_id));
  EXPECT_EQ(results.extend(claimed, 1000), 1u);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule"
                  " WHERE visible_at > now() + interval '900 seconds'"),
            "1");
}

}  // namespace
}  // namespace loopscope::storage
