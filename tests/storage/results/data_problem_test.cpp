#include <gmock/gmock.h>

#include "storage/loop_work.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

class DataProblemTest : public ResultsTest {
 protected:
  void SetUp() override {
    ResultsTest::SetUp();
    if (IsSkipped()) return;
    CatalogueEntry loop = loop_named("a");
    loop.op_tag = "a.OP";
    Catalogue(settings_for(*database)).save(std::vector{loop});
  }

  /// One visit at slot `hours`, with such flags and problems of tags.
  void visit(int hours, const std::vector<std::string>& flags,
             const std::vector<DataProblem>& of_tags = {}, bool usable = true) {
    database->execute("UPDATE loopscope.schedule SET visible_at = now() - interval '1 hour'");
    ResultsDatabase results = connect();
    const ClaimedLoop claim = claim_all(results).at(0);
    CompletedLoop loop = completed(claim, slot(hours), "digest");
    loop.previous_slot_end_us = claim.last_slot_end_us;
    loop.judged = usable;
    loop.record->diagnosis.evidence.data_quality = {};
    loop.record->diagnosis.evidence.data_quality.usable = usable;
    loop.record->diagnosis.evidence.data_quality.flags = flags;
    if (!usable) {
      loop.record->diagnosis.evidence.data_quality.reason = "pv has no usable sample";
      loop.record->diagnosis.verdict.code = core::diagnosis::VerdictCode::insufficient_data;
    }
    loop.problems = of_tags;
    for (const std::string& flag : flags) {
      loop.problems.push_back({flag, "", std::nullopt, std::nullopt});
    }
    if (!usable) loop.problems.push_back({"insufficient_data", "", std::nullopt, std::nullopt});
    not_judged = results.finish(std::vector{loop}, {}).not_judged;
  }
  [[nodiscard]] TextRows problems() const {
    return database->rows(
        "SELECT problem, role, tag, slots, since, judged FROM loopscope.data_problem"
        " ORDER BY problem, role");
  }

  std::size_t not_judged = 0;
};

TEST_F(DataProblemTest, SlotsInARowAreCountedFromTheFirst) {
  visit(1, {"op_constant"});
  visit(2, {"op_constant", "sp_missing"});
  visit(3, {"op_constant"});
  EXPECT_EQ(problems(),
            (TextRows{{"op_constant", "op", "a.OP", "3", "2026-01-01 01:00:00+00", "t"}}));
  visit(4, {});
  EXPECT_TRUE(problems().empty()) << "what is over is not shown";
  visit(5, {"op_constant"});
  EXPECT_EQ(problems(),
            (TextRows{{"op_constant", "op", "a.OP", "1", "2026-01-01 05:00:00+00", "t"}}));
  visit(5, {"op_constant"});
  EXPECT_EQ(problems().at(0).at(3), "1") << "the same slot again is no further slot";
}

TEST_F(DataProblemTest, DeadTagsStandInTheHealthOfTheMonitor) {
  visit(1, {}, {{"dead_tag", "pv", slot(-5), std::nullopt}, {"no_rows", "op", {}, {}}}, true);
  visit(2, {}, {{"dead_tag", "pv", slot(-5), std::nullopt}, {"no_rows", "op", {}, {}}}, true);
  EXPECT_EQ(problems(), (TextRows{{"dead_tag", "pv", "a.PV", "2", "2025-12-31 19:00:00+00", "t"},
                                  {"no_rows", "op", "a.OP", "2", "2026-01-01 01:00:00+00", "t"}}));
  const std::string health =
      "SELECT state, dead_roles, dead_tags, dead_since FROM loopscope.monitor_health";
  database->execute("UPDATE loopscope.schedule SET visible_at = now()");
  EXPECT_EQ(database->rows(health),
            (TextRows{{"dead_tag", "{op,pv}", "{a.OP,a.PV}",
                       R"({"2026-01-01 01:00:00+00","2025-12-31 19:00:00+00"})"}}));
  visit(3, {});
  database->execute("UPDATE loopscope.schedule SET visible_at = now()");
  EXPECT_EQ(database->rows(health), (TextRows{{"ok", "NULL", "NULL", "NULL"}}));
}

TEST_F(DataProblemTest, WhatCannotBeJudgedSaysWhy) {
  visit(1, {}, {{"bad_quality", "pv", std::nullopt, 0.75}}, false);
  EXPECT_EQ(not_judged, 1u);
  EXPECT_EQ(problems(),
            (TextRows{{"bad_quality", "pv", "a.PV", "1", "2026-01-01 01:00:00+00", "f"},
                      {"insufficient_data", "pv", "a.PV", "1", "2026-01-01 01:00:00+00", "f"}}));
  EXPECT_EQ(value("SELECT words FROM loopscope.data_problem WHERE problem = 'insufficient_data'"),
            "The loop cannot be judged: pv has no usable sample");
  EXPECT_EQ(value("SELECT figure FROM loopscope.data_problem WHERE problem = 'bad_quality'"),
            "0.75");
}

TEST_F(DataProblemTest, AnUnknownFlagIsShownAsItIs) {
  visit(1, {"cubic_test_refused", "sp_moving"});
  EXPECT_EQ(database->rows("SELECT problem, role, words, remedy FROM loopscope.data_problem"),
            (TextRows{{"cubic_test_refused", "NULL", "cubic test refused", ""}}));
}

TEST_F(DataProblemTest, LoopsThatAreSwitchedOffHaveNone) {
  visit(1, {"op_constant"});
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"a"}, false);
  EXPECT_TRUE(problems().empty());
}

// The flags of core/ in words: a new one needs its row in data_problem_kind.
TEST_F(DataProblemTest, EveryKindSaysWhatMendsIt) {
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.data_problem_kind"
                  " WHERE shown AND (words = '' OR remedy = '')"),
            "0");
}

}  // namespace
}  // namespace loopscope::storage
