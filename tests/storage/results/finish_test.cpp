#include <gmock/gmock.h>
#include <limits>

#include "storage/results/results_database.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

class FinishTest : public ResultsTest {};

TEST_F(FinishTest, StoresAnalysisPeaksAndVerdict) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  const WriteCount count = results.finish(std::vector{completed(claimed[0], slot(1), "d1")}, {});
  EXPECT_EQ(count.inserted, 1u);
  EXPECT_EQ(count.revised + count.unchanged + count.failed + count.fenced_off, 0u);

  EXPECT_EQ(
      database->rows("SELECT slot_end, algorithm_revision, input_revision, fence"
                     " FROM loopscope.analysis"),
      (TextRows{{"2026-01-01 01:00:00+00", std::to_string(core::kAlgorithmRevision), "1", "1"}}));
  EXPECT_EQ(
      database->rows("SELECT rank, f1, f2, bic2, p FROM loopscope.bicoherence_peak ORDER BY 1"),
      (TextRows{{"1", "0.125", "0.0625", "0.5", "0.001"}, {"2", "0.25", "0.125", "0.25", "NULL"}}));
  EXPECT_EQ(database->rows("SELECT code, confidence, summary, reasons[1], reasons[2], action,"
                           " analysis_id = (SELECT analysis_id FROM loopscope.analysis)"
                           " FROM loopscope.verdict"),
            (TextRows{{"valve_stiction", "0.875", "The valve sticks.", "first, with a comma",
                       "second 'quoted' \"reason\"", "Stroke it.", "t"}}));
  EXPECT_EQ(database->rows("SELECT owner, attempts, last_error, visible_at, last_slot_end,"
                           " result_slot_end FROM loopscope.schedule"),
            (TextRows{{"NULL", "0", "NULL", "2026-01-01 02:00:00+00", "2026-01-01 01:00:00+00",
                       "2026-01-01 01:00:00+00"}}));
}

TEST_F(FinishTest, ASlotAfterNowIsNotNewerThanOneOfToday) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const CompletedLoop done = completed(claim_all(results).at(0), slot(1), "d1");
  database->execute(
      "UPDATE loopscope.schedule SET last_slot_end = now() + interval '30 days',"
      " result_slot_end = now() + interval '30 days'");
  results.finish(std::vector{done}, {});
  EXPECT_EQ(database->rows("SELECT last_slot_end, result_slot_end FROM loopscope.schedule"),
            (TextRows{{"2026-01-01 01:00:00+00", "2026-01-01 01:00:00+00"}}));
}

TEST_F(FinishTest, ASlotThatHasNotComeIsNotStoredAndItsLoopIsDueAtOnce) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claims = claim_all(results);
  const std::int64_t tomorrow = results.clock().now_us + 86'400'000'000;
  const WriteCount count = results.finish(
      std::vector{completed(claims[0], tomorrow, "d"), completed(claims[1], slot(1), "d")}, {});
  EXPECT_EQ(count.inserted, 1u);
  EXPECT_EQ(count.fenced_off, 1u);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule WHERE owner IS NULL AND attempts = 0"
                  " AND visible_at <= now()"),
            "2");
  EXPECT_EQ(value("SELECT max(slot_end) <= now() FROM loopscope.analysis"), "t");
}

TEST_F(FinishTest, UnknownFiguresAreNull) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  CompletedLoop loop = completed(claim_all(results).at(0), slot(1), "d1");
  loop.record->diagnosis.evidence.hos.reset();
  loop.record->diagnosis.evidence.performance.harris_low = std::numeric_limits<double>::quiet_NaN();
  loop.record->diagnosis.evidence.data_quality.reason = "pv is constant";
  loop.record->diagnosis.verdict.confidence = std::numeric_limits<double>::quiet_NaN();
  loop.record->diagnosis.verdict.p = std::numeric_limits<double>::quiet_NaN();
  loop.record->diagnosis.verdict.summary = std::string("bad \xff and \0 bytes", 17);
  EXPECT_EQ(results.finish(std::vector{loop}, {}).inserted, 1u);
  EXPECT_EQ(value("SELECT num_nulls(ngi, segments, published_linear, coupling, harris_low)"
                  " FROM loopscope.analysis"),
            "5");
  EXPECT_EQ(value("SELECT unusable_reason FROM loopscope.analysis"), "pv is constant");
  EXPECT_EQ(value("SELECT confidence FROM loopscope.verdict"), "0");
  EXPECT_EQ(value("SELECT p FROM loopscope.verdict"), "1") << "null would say: needs no test";
  EXPECT_EQ(value("SELECT summary FROM loopscope.verdict"),
            "bad \xEF\xBF\xBD and \xEF\xBF\xBD bytes");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.bicoherence_peak"), "0");
}

TEST_F(FinishTest, LateRowsReviseEarlierSlotsBesideTheNewestOne) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  std::vector<ClaimedLoop> claimed = claim_all(results);
  results.finish(
      std::vector{completed(claimed[0], slot(1), "a1"), completed(claimed[1], slot(1), "b1")}, {});
  database->execute("UPDATE loopscope.schedule SET visible_at = now()");
  claimed = claim_all(results);
  std::vector done{completed(claimed[0], slot(2), "a2"), completed(claimed[1], slot(2), "b2")};
  done[0].revised.push_back(record_at(slot(1), "a1 late"));
  done[0].revised[0].diagnosis.verdict.code = core::diagnosis::VerdictCode::healthy;
  const WriteCount count = results.finish(done, {});
  EXPECT_EQ(count.inserted, 2u);
  EXPECT_EQ(count.revised, 0u) << "of newest slots";
  EXPECT_EQ(count.revised_earlier, 1u);
  EXPECT_EQ(results.finish(done, {}).revised_earlier, 0u) << "a repeat changes nothing";
  EXPECT_EQ(
      database->rows("SELECT loop_name, slot_end, input_revision, former_code, code,"
                     " code_changed, revised_at >= former_decided_at"
                     " FROM loopscope.revised_verdict"),
      (TextRows{{"a", "2026-01-01 01:00:00+00", "2", "valve_stiction", "healthy", "t", "t"}}));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.verdict"), "5");
  EXPECT_EQ(value("SELECT min(slot_end) FROM loopscope.latest_verdict"), "2026-01-01 02:00:00+00");
}

TEST_F(FinishTest, RepeatChangesNothing) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  const std::vector done{completed(claimed[0], slot(1), "d1")};
  const std::vector<FailedLoop> failed{{claimed[1].loop.loop_id, claimed[1].fence, "no rows", 60}};
  results.finish(done, failed);
  const auto before = database->rows("SELECT * FROM loopscope.loop_history");

  const WriteCount again = results.finish(done, failed);
  EXPECT_EQ(again.inserted, 0u);
  EXPECT_EQ(again.revised, 0u);
  EXPECT_EQ(again.unchanged, 1u);
  EXPECT_EQ(again.failed, 1u);
  EXPECT_EQ(database->rows("SELECT * FROM loopscope.loop_history"), before);
  EXPECT_EQ(value("SELECT max(attempts) FROM loopscope.schedule"), "1");
}

TEST_F(FinishTest, LostLeaseWritesNothing) {
  add_loops({"a", "b"});
  ResultsDatabase slow = connect();
  ResultsDatabase quick = connect();
  const std::vector<ClaimedLoop> lost = claim_all(slow);
  database->execute(kEndLeases);
  const std::vector<ClaimedLoop> taken = claim_all(quick);
  quick.finish(std::vector{completed(taken[0], slot(1), "new")}, {});

  const std::vector<FailedLoop> failed{{lost[1].loop.loop_id, lost[1].fence, "late", 60}};
  const WriteCount count = slow.finish(std::vector{completed(lost[0], slot(1), "old")}, failed);
  EXPECT_EQ(count.fenced_off, 2u);
  EXPECT_EQ(count.inserted + count.revised + count.unchanged + count.failed, 0u);
  EXPECT_EQ(value("SELECT input_digest FROM loopscope.analysis"), "new");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.verdict"), "1");
  EXPECT_EQ(slow.extend(lost, 100).size(), lost.size());
  slow.release(lost);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule WHERE owner IS NOT NULL"), "1")
      << "a stale release must not free what another worker holds";
}

TEST_F(FinishTest, ChangedInputRevisesTheRowAndKeepsTheFormerVerdict) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  results.finish(std::vector{completed(claim_all(results).at(0), slot(1), "d1")}, {});
  const std::string id = value("SELECT analysis_id FROM loopscope.analysis");
  database->execute(kEndLeases);

  CompletedLoop loop = completed(claim_all(results).at(0), slot(1), "d2");
  loop.record->diagnosis.verdict.code = core::diagnosis::VerdictCode::healthy;
  loop.record->diagnosis.evidence.hos->peaks.resize(1);
  const WriteCount count = results.finish(std::vector{loop}, {});
  EXPECT_EQ(count.revised, 1u);
  EXPECT_EQ(count.inserted, 0u);

  EXPECT_EQ(database->rows("SELECT input_revision, input_digest, fence FROM loopscope.analysis"),
            (TextRows{{"2", "d2", "2"}}));
  EXPECT_EQ(value("SELECT analysis_id FROM loopscope.analysis"), id);
  EXPECT_EQ(database->rows("SELECT input_revision, code, is_current FROM loopscope.loop_history"
                           " ORDER BY 1"),
            (TextRows{{"1", "valve_stiction", "NULL"}, {"2", "healthy", "t"}}));
  EXPECT_EQ(value("SELECT code FROM loopscope.latest_verdict"), "healthy");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.bicoherence_peak WHERE input_revision = 2"), "1");
}

TEST_F(FinishTest, WithoutRecordOnlyTheScheduleMoves) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const ClaimedLoop claim = claim_all(results).at(0);
  const CompletedLoop loop{claim.loop.loop_id, claim.fence, slot(1), slot(2), std::nullopt};
  EXPECT_EQ(results.finish(std::vector{loop}, {}).unchanged, 1u);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "0");
  EXPECT_EQ(value("SELECT last_slot_end FROM loopscope.schedule"), "2026-01-01 01:00:00+00");
  EXPECT_EQ(value("SELECT visible_at FROM loopscope.schedule"), "2026-01-01 02:00:00+00");
}

TEST_F(FinishTest, OlderSlotDoesNotBecomeTheLatest) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  results.finish(std::vector{completed(claim_all(results).at(0), slot(5), "d5")}, {});
  database->execute(kEndLeases);
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  EXPECT_EQ(claimed.at(0).last_slot_end_us, slot(5));
  results.finish(std::vector{completed(claimed[0], slot(4), "d4")}, {});
  EXPECT_EQ(value("SELECT slot_end FROM loopscope.latest_verdict"), "2026-01-01 05:00:00+00");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "2");
}

TEST_F(FinishTest, FailuresCountUpAndASuccessEndsThem) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  for (int attempt = 0; attempt < 3; ++attempt) {
    const ClaimedLoop claim = claim_all(results).at(0);
    EXPECT_EQ(claim.attempts, attempt);
    const std::vector<FailedLoop> failed{{claim.loop.loop_id, claim.fence, "tag unknown", 500.0}};
    EXPECT_EQ(results.finish({}, failed).failed, 1u);
    EXPECT_TRUE(claim_all(results).empty()) << "it is retried after the pause only";
    database->execute(kEndLeases);
  }
  EXPECT_EQ(value("SELECT last_error FROM loopscope.schedule"), "tag unknown");
  results.finish(std::vector{completed(claim_all(results).at(0), slot(1), "d1")}, {});
  EXPECT_EQ(value("SELECT attempts FROM loopscope.schedule"), "0");
  EXPECT_EQ(value("SELECT last_error FROM loopscope.schedule"), "NULL");
}

TEST_F(FinishTest, OneBadRowStoresNothingOfItsBatch) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  std::vector done{completed(claimed[0], slot(1), "d1"), completed(claimed[1], slot(1), "d1")};
  done[1].record->settings_json = "no JSON";
  EXPECT_THROW(results.finish(done, {}), DatabaseError);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "0");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule WHERE owner = 'worker'"), "2");
  done[1].record->settings_json = "{}";
  EXPECT_EQ(results.finish(done, {}).inserted, 2u) << "the connection is still good";
}

}  // namespace
}  // namespace loopscope::storage
