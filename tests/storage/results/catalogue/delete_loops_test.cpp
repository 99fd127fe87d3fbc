#include "storage/results/catalogue/delete_loops.hpp"

#include <gmock/gmock.h>

#include "storage/results/catalogue/annotations.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class DeleteLoopsTest : public ResultsTest {
 protected:
  /// Loops a, b and c with an analysis each and everything else that a loop may have.
  void fill() {
    add_loops({"a", "b", "c"});
    ResultsDatabase results = connect();
    std::vector<CompletedLoop> all;
    for (const ClaimedLoop& claim : claim_all(results))
      all.push_back(completed(claim, slot(1), "d"));
    for (CompletedLoop& one : all) explain(*one.record);
    results.finish(all, {});
    database->execute(
        "INSERT INTO loopscope.annotation (loop_id, kind) SELECT loop_id, 'acknowledged' FROM "
        "loopscope.loop;"
        "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description) SELECT "
        "loop_id, "
        "now(), 'valve', 'packing' FROM loopscope.loop;"
        "INSERT INTO loopscope.standing_problem (loop_id, code, role, first_slot, last_slot, slots)"
        " SELECT loop_id, 'pv_dead', '', now(), now(), 1 FROM loopscope.loop;"
        "INSERT INTO loopscope.flag_notice (loop_id, code, announced, slot_end, since, status, "
        "confidence, rank, score, summary) SELECT loop_id, 'valve_stiction', true, now(), now(), "
        "'watch', 0.9, 1, 1, 's' FROM loopscope.loop");
  }
  [[nodiscard]] std::string id(const std::string& name) const {
    return value("SELECT loop_id FROM loopscope.loop WHERE name = '" + name + "'");
  }
  /// Rows of each table with a loop's number, of that loop: "analysis 1" where there is one.
  [[nodiscard]] std::vector<std::string> rows_of(const std::string& loop_id) const {
    std::vector<std::string> found;
    for (const auto& table : database->rows(
             "SELECT format('%I', c.relname) FROM pg_class c JOIN pg_attribute a ON a.attrelid = "
             "c.oid WHERE c.relnamespace = 'loopscope'::regnamespace AND c.relkind IN ('r', 'p') "
             "AND NOT c.relispartition AND a.attname = 'loop_id' ORDER BY 1")) {
      const std::string count =
          value("SELECT count(*) FROM loopscope." + table[0] + " WHERE loop_id = " + loop_id);
      if (count != "0") found.push_back(table[0] + " " + count);
    }
    return found;
  }
  LoopsDeletion remove(const std::vector<std::string>& names, bool with_results = false) const {
    return delete_loops(settings_for(*database), names, with_results);
  }
};

TEST_F(DeleteLoopsTest, LeavesNothingBehindAndOthersAlone) {
  fill();
  const std::string a = id("a"), b = id("b");
  const std::vector<std::string> before = rows_of(b);
  EXPECT_THAT(before, testing::Contains("verdict 1"));
  EXPECT_THAT(before, testing::Contains("explanation_step 2"));
  EXPECT_EQ(before.size(), 10u) << "every table with loops has some: fill() lacks a new one";
  const LoopsDeletion deletion = remove({"a", "nobody"}, true);
  EXPECT_TRUE(deletion.deleted);
  EXPECT_EQ(deletion.loops, 1u);
  EXPECT_EQ(deletion.analyses, 1u);
  EXPECT_EQ(deletion.annotations, 1u);
  EXPECT_EQ(deletion.maintenance_events, 1u);
  EXPECT_THAT(rows_of(a), IsEmpty());
  EXPECT_EQ(rows_of(b), before);
}

TEST_F(DeleteLoopsTest, ResultsGoOnlyWhereThatIsSaid) {
  fill();
  add_loops({"new"});
  const LoopsDeletion refused = remove({"a", "b", "new"});
  EXPECT_FALSE(refused.deleted);
  EXPECT_EQ(refused.loops, 3u);
  EXPECT_EQ(refused.with_results, 2u);
  EXPECT_EQ(refused.analyses, 2u);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.loop"), "4");
  EXPECT_TRUE(remove({"new"}).deleted);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.loop"), "3");
}

TEST_F(DeleteLoopsTest, WhatAWorkerHoldsStays) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const auto claims = claim_all(results);
  EXPECT_THAT(remove({"a", "b"}, true).held, ElementsAre("a", "b"));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.loop"), "2");
  results.finish(std::vector{completed(claims[0], slot(1), "d")}, {});
  EXPECT_TRUE(remove({claims[0].loop.name}, true).deleted);
  // A lease that has ended holds nothing, and its worker's late result is refused.
  database->execute(kEndLeases);
  EXPECT_TRUE(remove({claims[1].loop.name}, true).deleted);
  EXPECT_EQ(results.finish(std::vector{completed(claims[1], slot(1), "d")}, {}).inserted, 0u);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "0");
}

TEST_F(DeleteLoopsTest, OscillationsLoseTheLoop) {
  add_loops({"a", "b", "c"});
  const std::string a = id("a"), b = id("b"), c = id("c");
  const auto add = [&](int number, const std::string& ids, const std::string& source) {
    database->execute(
        "INSERT INTO loopscope.plant_oscillation (slot_end, algorithm_revision, number, period_s, "
        "loop_ids, strengths, lags_s, source_loop_id, statement, roles, leads, traces) SELECT "
        "'2026-01-01', 1, " +
        std::to_string(number) + ", 60, ids, ids, ids, " + source +
        ", 's', array_fill('member'::text, array[cardinality(ids)]), jsonb_build_array("
        "jsonb_build_object('from_loop_id', " +
        a + ", 'to_loop_id', " + b + "), jsonb_build_object('from_loop_id', " + b +
        ", 'to_loop_id', " + c + ")), jsonb_build_array(jsonb_build_object('loop_id', " + a +
        "), jsonb_build_object('loop_id', " + c + ")) FROM (SELECT '{" + ids +
        "}'::bigint[] AS ids) AS one");
  };
  add(1, a + "," + b + "," + c, b);
  add(2, a + "," + b + "," + c, a);
  add(3, a + "," + b, "NULL");
  add(4, b + "," + c, "NULL");
  EXPECT_TRUE(remove({"a"}).deleted);
  EXPECT_EQ(value("SELECT string_agg(number::text, ',' ORDER BY number) FROM "
                  "loopscope.plant_oscillation"),
            "1,4");
  EXPECT_EQ(
      value("SELECT concat_ws('|', loop_ids, strengths, lags_s, roles, scores, "
            "jsonb_array_length(leads), jsonb_array_length(traces)) FROM "
            "loopscope.plant_oscillation WHERE number = 1"),
      "{" + b + "," + c + "}|{" + b + "," + c + "}|{" + b + "," + c + "}|{member,member}|1|1");
}

}  // namespace
}  // namespace loopscope::storage
