#include "storage/results/catalogue/repair_judgements.hpp"

#include <gmock/gmock.h>

#include "core/repair/figures.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/upgrade_fixture.hpp"
#include "tests/storage/results/views_fixture.hpp"

/// Which pieces of work are judged, and when again.
namespace loopscope::storage {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

class RepairJudgementsTest : public ViewsTest {
 protected:
  void SetUp() override {
    ViewsTest::SetUp();
    if (database == nullptr) return;
    add_loops({"a"});
    work_at("now() - interval '3 days'");
  }
  void work_at(const std::string& time, const std::string& description = "packing") const {
    database->execute(
        "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description) SELECT"
        " loop_id, " +
        time + ", 'valve', '" + description + "' FROM loopscope.loop");
  }
  [[nodiscard]] std::vector<DueRepair> due(const std::string& user = "") const {
    return RepairJudgements(settings_for(*database, user)).due(100);
  }
  void judge_due(const std::string& user = "") const {
    judge_due_repairs(settings_for(*database, user));
  }
  [[nodiscard]] std::string words() const {
    return value(
        "SELECT string_agg(coalesce(word, 'none'), ' ' ORDER BY maintenance_event_id)"
        " FROM loopscope.before_after_maintenance");
  }
};

TEST_F(RepairJudgementsTest, WhatWasJudgedIsNotDueUntilTheLoopHasANewerSlot) {
  ASSERT_THAT(due(), SizeIs(1));
  judge_due();
  EXPECT_THAT(due(), IsEmpty());
  tell({{.loop = "a", .slot_hours = 1}});
  EXPECT_THAT(due(), SizeIs(1));
  judge_due();
  EXPECT_THAT(due(), IsEmpty());
  tell({{.loop = "a", .slot_hours = 2}});
  EXPECT_THAT(due(), SizeIs(1));
}

TEST_F(RepairJudgementsTest, OtherWorkOnTheLoopMakesItDueAgain) {
  judge_due();
  work_at("now() - interval '1 day'", "packing again");
  EXPECT_THAT(due(), SizeIs(2));
  judge_due();
  EXPECT_THAT(due(), IsEmpty());
}

/// Times of entry do not count: clocks are set, and transactions commit later than they began.
TEST_F(RepairJudgementsTest, WorkOfAnotherTimeOrThatIsGoneMakesItDueAgain) {
  work_at("now() - interval '1 day'", "packing again");
  judge_due();
  database->execute("UPDATE loopscope.maintenance_event SET entered_at = now() + interval '1 day'");
  EXPECT_THAT(due(), IsEmpty());
  database->execute(
      "UPDATE loopscope.maintenance_event SET done_at = done_at - interval '1 hour'"
      " WHERE description = 'packing'");
  EXPECT_THAT(due(), SizeIs(2));
  judge_due();
  database->execute("DELETE FROM loopscope.maintenance_event WHERE description = 'packing again'");
  EXPECT_THAT(due(), SizeIs(1));
}

TEST_F(RepairJudgementsTest, WorkOfAnyYearIsJudged) {
  for (const char* year : {"'4713-01-01 BC'", "'294276-01-01'", "'0001-01-01'"})
    work_at(year, "any year");
  EXPECT_THAT(due(), SizeIs(4));
  judge_due();
  EXPECT_THAT(due(), IsEmpty());
}

TEST_F(RepairJudgementsTest, FiguresOfADamagedRowAreLeftOut) {
  database->execute("DELETE FROM loopscope.maintenance_event");
  work_at("'2026-01-01 05:00+00'");
  tell({{.loop = "a", .slot_hours = 2}});
  database->execute(
      "INSERT INTO loopscope.explanation_step (loop_id, slot_end, algorithm_revision,"
      " input_revision, step, effect, parameters, intervals, statement) SELECT loop_id, slot_end,"
      " algorithm_revision, input_revision, 1, 'valve_stiction',"
      R"( '{"S": 1e400, "J": [1], "x": null, "y": "1", "z": 2}', '{}', '' FROM loopscope.analysis;)"
      "UPDATE loopscope.analysis SET harris_low = 1e-200, harris_high = 1e-200");
  ASSERT_THAT(due(), SizeIs(1));
  ASSERT_THAT(due()[0].windows.before, SizeIs(1));
  ASSERT_THAT(due()[0].windows.before[0].effects, SizeIs(1));
  EXPECT_EQ(due()[0].windows.before[0].effects[0].value, 2.0);
}

/// The windows of some are found without those of all.
TEST_F(RepairJudgementsTest, ABatchAsksForItsOwnWindowsAlone) {
  database->execute(
      "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description) SELECT"
      " loop_id, now() - number * interval '1 h', 'valve', 'x' FROM loopscope.loop"
      " CROSS JOIN generate_series(1, 300) AS number");
  const std::vector<DueRepair> first = RepairJudgements(settings_for(*database)).due(100);
  ASSERT_THAT(first, SizeIs(100));
  const auto second =
      RepairJudgements(settings_for(*database)).due(100, first.back().maintenance_event_id);
  ASSERT_THAT(second, SizeIs(100));
  EXPECT_GT(second.front().maintenance_event_id, first.back().maintenance_event_id);
}

TEST_F(RepairJudgementsTest, AnotherThresholdOrRevisionMakesItDueAgain) {
  judge_due();
  database->execute("UPDATE loopscope.parameter SET value = 0.7 WHERE name = 'min_confidence'");
  ASSERT_THAT(due(), SizeIs(1));
  EXPECT_EQ(due()[0].windows.min_confidence, 0.7);
  judge_due();
  EXPECT_THAT(due(), IsEmpty());
  database->execute("UPDATE loopscope.repair_judgement SET algorithm_revision = 1");
  EXPECT_THAT(due(), SizeIs(1));
  database->execute("UPDATE loopscope.repair_judgement SET algorithm_revision = 1000000");
  EXPECT_THAT(due(), IsEmpty()) << "a later program's judgement stands";
}

TEST_F(RepairJudgementsTest, WorkOfMoreThanAYearAgoIsJudgedOnce) {
  database->execute("UPDATE loopscope.maintenance_event SET done_at = now() - interval '2 years'");
  judge_due();
  tell({{.loop = "a", .slot_hours = 1}});
  EXPECT_THAT(due(), IsEmpty());
}

TEST_F(RepairJudgementsTest, AnOutcomeStaysWhenItsWindowsAreDeleted) {
  database->execute("DELETE FROM loopscope.maintenance_event");
  work_at("'2026-01-01 05:00+00'");
  tell({{.loop = "a", .harris = 0.2, .slot_hours = 2, .error_std = 4},
        {.loop = "a", .code = kHealthy, .slot_hours = 8, .error_std = 1}});
  RepairJudgements judgements(settings_for(*database));
  DueRepair repair = judgements.due(1).at(0);
  judge_due();
  EXPECT_EQ(words(), "fixed");
  repair.windows.before.clear();
  const auto without = core::repair::judge_repair(repair.windows);
  judgements.store(std::vector{JudgedRepair{repair, without}});
  EXPECT_EQ(words(), "fixed");
  work_at("'2026-01-01 01:30+00'", "other work");
  repair = judgements.due(1).at(0);
  repair.windows.before.clear();
  judgements.store(std::vector{JudgedRepair{repair, without}});
  EXPECT_EQ(value("SELECT count(word) FROM loopscope.repair_judgement"), "0")
      << "other work takes the windows away";
}

TEST_F(RepairJudgementsTest, WorkThatWasDeletedMeanwhileIsLeftOut) {
  RepairJudgements judgements(settings_for(*database));
  const DueRepair repair = judgements.due(1).at(0);
  database->execute("DELETE FROM loopscope.maintenance_event");
  judgements.store(std::vector{JudgedRepair{repair, core::repair::judge_repair(repair.windows)}});
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.repair_judgement"), "0");
}

TEST_F(RepairJudgementsTest, ABatchEndsAtItsLimit) {
  for (int k = 0; k < 4; ++k) work_at("now() - interval '2 days'", "work " + std::to_string(k));
  EXPECT_THAT(RepairJudgements(settings_for(*database)).due(3), SizeIs(3));
}

TEST_F(RepairJudgementsTest, AWorkersRightsAreEnough) {
  const std::string worker = database->make_login("loopscope_worker");
  judge_due(worker);
  tell({{.loop = "a", .slot_hours = 1}});
  judge_due(worker);
  EXPECT_THAT(due(), IsEmpty());
}

TEST_F(RepairJudgementsTest, FiguresThatAreNoNumberAreNull) {
  DueRepair repair = due().at(0);
  core::repair::RepairWindow window;
  window.error_std = 1e-300;
  repair.windows.before.push_back(window);
  window.error_std = 1e300;
  repair.windows.after.push_back(window);
  RepairJudgements(settings_for(*database))
      .store(std::vector{JudgedRepair{repair, core::repair::judge_repair(repair.windows)}});
  EXPECT_EQ(value("SELECT figures->'error_std'->>'change' FROM loopscope.repair_judgement"),
            "NULL");
  EXPECT_EQ(value("SELECT variance_ratio FROM loopscope.repair_judgement"), "NULL");
}

/// One catalogue of figures: what SQL says of one is what the program says.
TEST_F(RepairJudgementsTest, FigureKindsAreTheProgramsCatalogue) {
  for (const core::repair::FigureKind& kind : core::repair::figure_kinds()) {
    const std::string name = std::string(kind.name);
    EXPECT_EQ(
        database->rows("SELECT DISTINCT coalesce(family, ''), is_ratio, ordinary::float8,"
                       " apart::float8, unit, meaning FROM loopscope.figure_kind"
                       " WHERE figure = '" +
                       name + "'"),
        database->rows("SELECT '" + std::string(kind.family) + "', " +
                       (kind.is_ratio ? "true" : "false") + ", " + std::to_string(kind.ordinary) +
                       "::float8, " + std::to_string(kind.apart) + "::float8, '" +
                       std::string(kind.unit) + "', $m$" + std::string(kind.meaning) + "$m$"))
        << name;
  }
  EXPECT_EQ(value("SELECT count(DISTINCT figure) FROM loopscope.figure_kind"),
            std::to_string(core::repair::figure_kinds().size()));
}

using RepairUpgradeTest = UpgradeTest;

/// A filled schema 27: the view computed the word then; the program says the same now, but for
/// "1 windows", and what it said where no window lies before the work.
TEST_F(RepairUpgradeTest, WorkOfSchema27IsJudgedAsItsViewDid) {
  tests::TestDatabase other;
  const std::string login = fill_former_schema(other, 27);
  other.execute("SET jit = off");  // the former view takes 8 s to compile
  other.execute(
      "UPDATE loopscope.analysis SET error_std = 4, harris_low = 0.2, harris_high = 0.2;"
      "INSERT INTO loopscope.analysis (loop_id, slot_end, algorithm_revision, analysis_id, fence,"
      " program_version, settings, input_digest, fetch_ms, analyse_ms, window_start, window_end,"
      " samples, interval_s, usable, flags, oscillating, error_std, harris_low, harris_high)"
      " SELECT loop_id, slot_end + interval '1 day', 1, nextval('loopscope.analysis_id'), 1,"
      " '0.1.0', '{}', 'd', 1, 1, window_start + interval '1 day', window_end + interval '1 day',"
      " 4096, 1, true, '{}', false, 1, 0.8, 0.8 FROM loopscope.analysis;"
      "INSERT INTO loopscope.verdict (loop_id, slot_end, algorithm_revision, input_revision,"
      " analysis_id, code, confidence, summary, reasons, action) SELECT loop_id, slot_end, 1, 1,"
      " analysis_id, CASE loop_id WHEN 1 THEN 'healthy' ELSE 'valve_deadband' END, 0.9, 'x', '{}',"
      " 'y' FROM loopscope.analysis WHERE slot_end > '2026-01-02';"
      "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
      " SELECT loop_id, '2026-01-01 12:00+00', 'valve', 'packing' FROM loopscope.loop");
  const std::string shown =
      "SELECT loop_name, word, CASE WHEN windows_before > 0 THEN replace(statement, 'of 1 windows',"
      " 'of 1 window') END, windows_before, "
      "windows_after, fault_before, fault_after,"
      " round(variance_ratio::numeric, 9), round(variance_ratio_low::numeric, 9),"
      " round(variance_ratio_high::numeric, 9), slot_end_before, error_std_ratio"
      " FROM loopscope.before_after_maintenance ORDER BY loop_name";
  const std::string figures =
      "SELECT figure, windows_before, round(before::numeric, 9), round(after_low::numeric, 9),"
      " round(change_high::numeric, 9), is_ratio, unit FROM loopscope.maintenance_figure"
      " WHERE figure <> 'nonlinear_p' ORDER BY loop_id, figure";
  const TextRows by_view = other.rows(shown), figures_by_view = other.rows(figures);
  EXPECT_EQ(by_view.at(0).at(1), "fixed");
  migrate(settings_for(other, login));
  EXPECT_EQ(other.value("SELECT count(word) FROM loopscope.before_after_maintenance"), "0");
  judge_due_repairs(settings_for(other, other.make_login("loopscope_worker")));
  EXPECT_EQ(other.rows(shown), by_view);
  EXPECT_EQ(other.rows(figures), figures_by_view);
}

}  // namespace
}  // namespace loopscope::storage
