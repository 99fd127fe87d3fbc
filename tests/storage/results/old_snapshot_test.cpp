#include <chrono>
#include <gmock/gmock.h>
#include <thread>

#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/delayed_server.hpp"

namespace loopscope::storage {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// Claims beside somebody's old snapshot, under which nothing dead can be removed.
class OldSnapshotTest : public ResultsTest {
 protected:
  /// Claims everything and gives it back, due again at once; pages that were looked at.
  [[nodiscard]] long visit_all(const std::shared_ptr<ClaimWatermarks>& watermarks) const {
    const long before = pages();
    {
      ResultsDatabase results(settings_for(*database), {}, watermarks);
      const std::int64_t due_us = results.clock().now_us;
      for (int batch = 0; batch < kLoops / kBatch; ++batch) {
        std::vector<CompletedLoop> done;
        for (const ClaimedLoop& claim : results.claim_due("me", 100, kBatch))
          done.push_back({claim.loop.loop_id, claim.fence, slot(1), due_us + batch, std::nullopt});
        EXPECT_THAT(done, SizeIs(kBatch));
        results.finish(done, {});
      }
    }
    // What a session has counted is told when it goes.
    while (value("SELECT count(*) FROM pg_stat_activity WHERE datname = current_database()"
                 " AND application_name LIKE 'loopscope%'") != "0")
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return pages() - before;
  }
  [[nodiscard]] long pages() const {
    return std::stol(
        value("SELECT heap_blks_hit + heap_blks_read + idx_blks_hit + idx_blks_read"
              " FROM pg_statio_user_tables WHERE relid = 'loopscope.schedule'::regclass"));
  }
  static constexpr int kLoops = 60;
  static constexpr int kBatch = 20;
};

/// While the index under the snapshot gets its second level, some twenty periods long, the cost
/// rises a little; single periods differ by where rows fall on pages. Later it must not rise at
/// all, though dead rows grow in number.
TEST_F(OldSnapshotTest, ClaimsAndCompletionsCostAsMuchAfterAHundredPeriodsAsAtFirst) {
  std::vector<std::string> names;
  for (int k = 0; k < kLoops; ++k) names.push_back("L" + std::to_string(k));
  add_loops(names);
  database->execute("ALTER TABLE loopscope.schedule SET (autovacuum_enabled = false)");
  const auto watermarks = std::make_shared<ClaimWatermarks>();
  static_cast<void>(visit_all(watermarks));
  const tests::SqlConnection reader(database->conninfo());
  reader.run("BEGIN ISOLATION LEVEL REPEATABLE READ");
  reader.run("SELECT count(*) FROM loopscope.schedule");
  const auto periods = [&](int count) {
    long sum = 0;
    for (int period = 0; period < count; ++period) sum += visit_all(watermarks);
    return static_cast<double>(sum) / count;
  };
  const double first = periods(10);
  static_cast<void>(periods(20));
  const double after_thirty = periods(10);
  static_cast<void>(periods(60));
  const double after_a_hundred = periods(10);
  EXPECT_GT(first, kLoops) << "something was counted";
  EXPECT_LT(after_thirty, 1.5 * first);
  EXPECT_LT(after_a_hundred, 1.1 * after_thirty);
}

/// Whatever comes to lie before the watermark is found by the claim that finds nothing.
TEST_F(OldSnapshotTest, WhatLiesBeforeTheFloorIsFound) {
  add_loops({"a", "b", "c"});
  ResultsDatabase results = connect();
  for (const char* const when :
       {"now() - interval '1 ms'", "now() - interval '50 s'", "now() - interval '3 h'",
        "now() - interval '40 days'", "'1970-01-01'", "'4713-01-01 BC'"}) {
    ASSERT_THAT(claim_all(results), SizeIs(3)) << when;
    ASSERT_THAT(claim_all(results), IsEmpty());
    database->execute(std::string("UPDATE loopscope.schedule SET owner = NULL, visible_at = ") +
                      when);
  }
}

TEST_F(OldSnapshotTest, ALoopLeftOutIsFoundBeforeTheFloorOfTheOthers) {
  add_loops({"a", "b"});
  database->execute("UPDATE loopscope.loop SET source = 'away' WHERE name = 'b'");
  ResultsDatabase results = connect();
  ASSERT_THAT(results.claim_due("me", 60, 10, {"away"}), SizeIs(1));
  ASSERT_THAT(results.claim_due("me", 60, 10, {"away"}), IsEmpty());
  database->execute(
      "UPDATE loopscope.schedule SET owner = NULL, visible_at = now() - interval '2 h'");
  EXPECT_THAT(results.claim_due("me", 60, 10, {"away"}), SizeIs(1));
  EXPECT_THAT(results.claim_due("me", 60, 10), SizeIs(1)) << "it is not away any more";
}

/// Thirty ways there and back of 20 ms: a look that counted those would end after one.
TEST_F(OldSnapshotTest, WhatLiesFarBackIsFoundOverASlowLine) {
  add_loops({"a"});
  const tests::DelayedServer slow(std::chrono::milliseconds(10));
  ConnectionSettings settings = settings_for(*database);
  settings.conninfo = slow.conninfo(settings.conninfo);
  ResultsDatabase results(settings);
  ASSERT_THAT(claim_all(results), SizeIs(1));
  ASSERT_THAT(claim_all(results), IsEmpty());
  database->execute(
      "UPDATE loopscope.schedule SET owner = NULL, visible_at = now() - interval '40 days'");
  EXPECT_THAT(claim_all(results), SizeIs(1));
}

/// Else every claim would begin there, as long as the transaction stays open.
TEST_F(OldSnapshotTest, ARowThatAForgottenTransactionHasLockedLowersNoFloor) {
  add_loops({"a", "b"});
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() - interval '2 h' WHERE loop_id = 1");
  const tests::SqlConnection forgotten(database->conninfo());
  forgotten.run("BEGIN; SELECT FROM loopscope.schedule WHERE loop_id = 1 FOR UPDATE");
  const auto watermarks = std::make_shared<ClaimWatermarks>();
  ResultsDatabase results(settings_for(*database), {}, watermarks);
  ASSERT_THAT(claim_all(results), SizeIs(1));
  const std::optional<DuePlace> watermark = watermarks->of({}).place();
  results.look_back();
  EXPECT_EQ(watermarks->of({}).place(), watermark);
  forgotten.run("ROLLBACK");
  results.look_back();
  EXPECT_LT(watermarks->of({}).place(), watermark);
}

/// A claim that was not committed leaves its loops where they were.
TEST_F(OldSnapshotTest, WhatWasLockedIsFoundWhenItIsFree) {
  add_loops({"a", "b"});
  const tests::SqlConnection other(database->conninfo());
  other.run("BEGIN; SELECT FROM loopscope.schedule WHERE loop_id = 1 FOR UPDATE");
  ResultsDatabase results = connect();
  EXPECT_THAT(claim_all(results), SizeIs(1));
  EXPECT_THAT(claim_all(results), IsEmpty());
  other.run("ROLLBACK");
  EXPECT_THAT(claim_all(results), SizeIs(1));
}

TEST_F(OldSnapshotTest, ALoopThatIsEnabledAgainIsDueNow) {
  add_loops({"a"});
  Catalogue catalogue(settings_for(*database));
  catalogue.set_enabled(std::vector<std::string>{"a"}, false);
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() - interval '90 days', fence = 1");
  catalogue.set_enabled(std::vector<std::string>{"a"}, true);
  EXPECT_EQ(value("SELECT now() - visible_at < interval '1 minute' FROM loopscope.schedule"), "t");
}

/// The key has the fence in it, so that it does not see to this any more.
TEST_F(OldSnapshotTest, NoLoopHasTwoRows) {
  add_loops({"a"});
  for (const char* const fence : {"0", "7"}) {
    EXPECT_THROW(database->execute("INSERT INTO loopscope.schedule (loop_id, enabled, fence)"
                                   " SELECT loop_id, true, " +
                                   std::string(fence) + " FROM loopscope.loop"),
                 std::runtime_error);
  }
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule"), "1");
}

}  // namespace
}  // namespace loopscope::storage
