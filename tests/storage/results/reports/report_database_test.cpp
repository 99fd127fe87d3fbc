#include "storage/results/reports/report_database.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <map>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::SizeIs;

class ReportDatabaseTest : public ViewsTest {
 protected:
  [[nodiscard]] ReportDatabase report() const { return ReportDatabase(settings_for(*database)); }
  [[nodiscard]] std::int64_t id(const std::string& loop) const {
    return std::stoll(value("SELECT loop_id FROM loopscope.loop WHERE name = '" + loop + "'"));
  }
  void annotate(const std::string& loop) const {
    database->execute("INSERT INTO loopscope.annotation (loop_id, kind) VALUES (" +
                      std::to_string(id(loop)) + ", 'acknowledged')");
  }
  /// `source` swings `victim`.
  void oscillate(const std::string& source, const std::string& victim) const {
    PlantRounds(settings_for(*database))
        .store({slot(1),
                1,
                9,
                2,
                {{40.0,
                  id(source),
                  source + " leads",
                  0.001,
                  {{id(victim), "victim", 0.25, 3.0, 0.5},
                   {id(source), "source", 0.75, 0.0, std::nullopt}}}}});
  }
};

TEST_F(ReportDatabaseTest, FlaggedLoopsAsTheViewHasThem) {
  tell({{.loop = "a", .confidence = 0.75, .harris = 0.2, .slot_hours = 1},
        {.loop = "a", .confidence = 0.75, .harris = 0.2, .slot_hours = 3},
        {.loop = "b", .confidence = 0.5, .p = 1e-9, .nonlinear_p = 1e-9, .harris = 0.2}});
  oscillate("b", "a");
  const std::vector<FlaggedRow> list = report().flagged();
  ASSERT_THAT(list, SizeIs(1)) << "a is b's victim";
  const FlaggedRow& b = list[0];
  EXPECT_EQ(b.rank, 1);
  EXPECT_EQ(b.loop_id, id("b"));
  EXPECT_EQ(b.loop_name, "b");
  EXPECT_EQ(b.source, value("SELECT source FROM loopscope.loop WHERE name = 'b'"));
  EXPECT_EQ(b.loop_type, std::nullopt);
  EXPECT_EQ(b.code, "valve_stiction");
  EXPECT_DOUBLE_EQ(b.severity, 0.8);
  EXPECT_DOUBLE_EQ(b.importance, 1.0);
  EXPECT_DOUBLE_EQ(b.kind_weight, 1.0);
  EXPECT_DOUBLE_EQ(b.score, 0.4);
  EXPECT_EQ(b.p, 1e-9);
  EXPECT_EQ(b.nonlinear_p, 1e-9);
  EXPECT_EQ(b.status, "watch");
  EXPECT_EQ(b.since_us, slot(1));
  EXPECT_EQ(b.slot_end_us, slot(1));
  EXPECT_EQ(b.input_revision, 1);
  EXPECT_EQ(b.summary, "The valve sticks.");
  EXPECT_THAT(b.reasons, ElementsAre("first, with a comma", "second 'quoted' \"reason\""));
  EXPECT_EQ(b.action, "Stroke it.");
  EXPECT_EQ(b.ngi, 0.0125);
  EXPECT_EQ(b.oscillation_period_s, 40.0);
  EXPECT_EQ(b.harris_high, 0.2);
  EXPECT_EQ(b.plant_oscillation_number, 1);
}

TEST_F(ReportDatabaseTest, CountsAddUp) {
  tell({{.loop = "old", .slot_hours = 1},
        {.loop = "first window", .slot_hours = 9},
        {.loop = "new", .code = VerdictCode::healthy, .slot_hours = 1},
        {.loop = "new", .slot_hours = 9},
        {.loop = "known"},
        {.loop = "victim"},
        {.loop = "fine", .code = VerdictCode::healthy},
        {.loop = "dead", .code = VerdictCode::insufficient_data, .usable = false},
        {.loop = "dead too", .code = VerdictCode::insufficient_data, .usable = false},
        {.loop = "off"},
        {.loop = "manual", .code = VerdictCode::not_controlling}});
  database->execute(
      "UPDATE loopscope.analysis SET unusable_reason = 'the controller was in manual for ' ||"
      " round(random() * 100) || ' % of the window', flags = '{}' WHERE NOT usable");
  add_loops({"never"});
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"off"}, false);
  annotate("known");
  oscillate("old", "victim");
  const PlantCounts counts = report().counts(slot(5));
  EXPECT_EQ(counts.loops + 100 * counts.enabled, 1011);
  EXPECT_EQ(counts.without_controller.at(0).loop_name, "manual");
  EXPECT_EQ(counts.judged + 10 * counts.not_controlling, 16);
  EXPECT_EQ(counts.unjudgeable + 10 * counts.never_analysed, 12);
  EXPECT_EQ(counts.judged + counts.not_controlling + counts.unjudgeable + counts.never_analysed,
            10);
  EXPECT_EQ(counts.flagged + 10 * counts.new_flags, 13) << "what was there at first may be older";
  EXPECT_EQ(counts.victims + 10 * counts.annotated + 100 * counts.fixed, 11);
  ASSERT_THAT(counts.reasons, SizeIs(1)) << "whatever the figures in the words";
  EXPECT_EQ(counts.reasons[0].words,
            "The loop cannot be judged: the controller was in manual for ... of the window");
  EXPECT_EQ(counts.reasons[0].loops, 2);
  EXPECT_THAT(counts.reasons[0].names, ElementsAre("dead", "dead too"));
  EXPECT_GT(counts.now_us, slot(0));
}

TEST_F(ReportDatabaseTest, HistoryHasTheNewestRevisionOfEachSlot) {
  tell({{.loop = "a", .slot_hours = 1, .error_std = 3},
        {.loop = "a", .code = VerdictCode::healthy, .slot_hours = 2, .error_std = 4},
        {.loop = "b"}});
  database->execute(
      "INSERT INTO loopscope.verdict SELECT loop_id, slot_end, algorithm_revision, 2, analysis_id,"
      " 'tight_tuning', 0.5, '', '{}', '' FROM loopscope.verdict WHERE slot_end = '2026-01-01"
      " 01:00+00' AND loop_id = " +
      std::to_string(id("a")) +
      ";"
      "UPDATE loopscope.analysis SET input_revision = 2 WHERE slot_end = '2026-01-01 01:00+00'");
  const std::vector<HistoryPoint> points = report().history(id("a"), slot(0));
  ASSERT_THAT(points, SizeIs(2));
  EXPECT_EQ(points[0].slot_end_us, slot(1));
  EXPECT_EQ(points[0].code, "tight_tuning");
  EXPECT_EQ(points[0].confidence, 0.5);
  EXPECT_EQ(points[0].error_std, 3.0);
  EXPECT_EQ(points[1].code, "healthy");
  EXPECT_EQ(points[1].oscillation_period_s, 40.0);
  EXPECT_THAT(report().history(id("a"), slot(2)), SizeIs(1));
}

TEST_F(ReportDatabaseTest, RepairsWithTheirFigures) {
  tell({{.loop = "a", .harris = 0.2, .slot_hours = 2, .error_std = 4},
        {.loop = "a", .code = VerdictCode::healthy, .slot_hours = 8, .error_std = 1}});
  database->execute(
      "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
      " SELECT loop_id, '2026-01-01 05:00+00', 'valve', 'new packing' FROM loopscope.loop");
  judge_repairs();
  const std::vector<RepairRow> repairs = report().repairs(slot(0));
  ASSERT_THAT(repairs, SizeIs(1));
  EXPECT_EQ(repairs[0].loop_name, "a");
  EXPECT_EQ(repairs[0].done_at_us, slot(5));
  EXPECT_EQ(repairs[0].kind + ": " + repairs[0].description, "valve: new packing");
  EXPECT_EQ(repairs[0].code_before, "valve_stiction");
  EXPECT_EQ(repairs[0].code_after, "healthy");
  EXPECT_EQ(repairs[0].windows_before, 1);
  EXPECT_EQ(repairs[0].windows_after, 1);
  EXPECT_FALSE(repairs[0].statement.empty());
  const auto found = std::ranges::find(repairs[0].figures, "error_std", &RepairFigure::name);
  ASSERT_NE(found, repairs[0].figures.end());
  EXPECT_EQ(found->unit, "pv units");
  EXPECT_TRUE(found->is_ratio);
  EXPECT_NEAR(found->before.value(), 4.0, 1e-9);
  EXPECT_NEAR(found->after.value(), 1.0, 1e-9);
  EXPECT_NEAR(found->change.value(), 0.25, 1e-9);
  EXPECT_LT(found->change_low.value(), 0.25);
  EXPECT_GT(found->change_high.value(), 0.25);
  EXPECT_THAT(report().repairs(slot(6)), IsEmpty());
  EXPECT_THAT(report().repairs_of(id("a")), SizeIs(1));
}

TEST_F(ReportDatabaseTest, SharedOscillationsTheSourceFirst) {
  tell({{.loop = "a"}, {.loop = "b"}});
  EXPECT_THAT(report().plant_oscillations(), IsEmpty());
  oscillate("a", "b");
  const std::vector<PlantOscillationRow> events = report().plant_oscillations();
  ASSERT_THAT(events, SizeIs(1));
  EXPECT_EQ(events[0].number, 1);
  EXPECT_EQ(events[0].period_s, 40.0);
  EXPECT_EQ(events[0].source_name, "a");
  EXPECT_EQ(events[0].statement, "a leads");
  EXPECT_EQ(events[0].slot_end_us, slot(1));
  EXPECT_EQ(events[0].p, 0.001);
  ASSERT_THAT(events[0].members, SizeIs(2));
  EXPECT_EQ(events[0].members[0].role, "source");
  EXPECT_EQ(events[0].members[0].score, std::nullopt);
  EXPECT_EQ(events[0].members[1].loop_name, "b");
  EXPECT_EQ(events[0].members[1].lag_s, 3.0);
  EXPECT_EQ(events[0].members[1].score, 0.5);
}

TEST_F(ReportDatabaseTest, ProblemsOfALoopsData) {
  tell({{.loop = "a"}});
  const std::vector<DataProblemRow> problems = report().data_problems(id("a"));
  ASSERT_FALSE(problems.empty());
  EXPECT_THAT(problems,
              testing::Contains(testing::AllOf(
                  Field(&DataProblemRow::code, "sp_missing"), Field(&DataProblemRow::role, "sp"),
                  Field(&DataProblemRow::tag, ""), Field(&DataProblemRow::since_us, slot(1)),
                  Field(&DataProblemRow::judged, true))));
}

TEST_F(ReportDatabaseTest, TheNewestVerdictOfAnyLoop) {
  tell({{.loop = "a"},
        {.loop = "fine", .code = VerdictCode::healthy, .slot_hours = 1},
        {.loop = "fine", .code = VerdictCode::healthy, .slot_hours = 3}});
  add_loops({"never"});
  ReportDatabase results = report();
  EXPECT_EQ(results.latest("a")->rank, 1);
  const std::optional<FlaggedRow> fine = results.latest("fine");
  ASSERT_TRUE(fine);
  EXPECT_EQ(fine->rank, 0);
  EXPECT_EQ(fine->code, "healthy");
  EXPECT_EQ(fine->kind_weight, 0.0);
  EXPECT_EQ(fine->since_us, slot(1));
  EXPECT_EQ(fine->slot_end_us, slot(3));
  EXPECT_EQ(results.latest("never"), std::nullopt);
  EXPECT_EQ(results.latest("x"), std::nullopt);
  EXPECT_EQ(results.latest("\xff"), std::nullopt);
}

TEST_F(ReportDatabaseTest, EveryLoopAndWhyAFaultIsNotFlagged) {
  tell({{.loop = "flagged"},
        {.loop = "known"},
        {.loop = "victim"},
        {.loop = "unsure", .confidence = 0.1},
        {.loop = "chance", .p = 0.04, .nonlinear_p = 0.04},
        {.loop = "fine", .code = VerdictCode::healthy, .nonlinear_p = 0.5},
        {.loop = "off"}});
  add_loops({"never"});
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"off"}, false);
  annotate("known");
  oscillate("flagged", "victim");
  const ListedLoops list = report().loops();
  std::map<std::string_view, LoopRow> loops;
  for (const LoopRow loop : list) loops[loop.name] = loop;
  ASSERT_EQ(loops.size(), 8U);
  EXPECT_EQ(loops["flagged"].rank, 1);
  EXPECT_EQ(loops["flagged"].status, "watch");
  EXPECT_EQ(loops["flagged"].hidden_by, std::nullopt);
  EXPECT_EQ(loops["flagged"].health, "ok");
  EXPECT_EQ(loops["known"].hidden_by, "annotated");
  EXPECT_EQ(loops["victim"].hidden_by, "affected by a shared oscillation");
  EXPECT_EQ(loops["unsure"].hidden_by, "not sure enough for the list (probability 0.10)");
  EXPECT_THAT(*loops["chance"].hidden_by, testing::HasSubstr("by chance too often"));
  EXPECT_EQ(loops["fine"].hidden_by, std::nullopt);
  EXPECT_EQ(loops["off"].hidden_by, "disabled");
  EXPECT_FALSE(loops["off"].enabled);
  EXPECT_EQ(loops["never"].code, std::nullopt);
  EXPECT_EQ(loops["never"].health, "never_analysed");
}

TEST_F(ReportDatabaseTest, IsOfOneMoment) {
  tell({{.loop = "a"}});
  ReportDatabase results = report();
  EXPECT_EQ(results.counts(slot(0)).flagged, 1);
  tell({{.loop = "b"}, {.loop = "a", .code = VerdictCode::healthy, .slot_hours = 2}});
  EXPECT_EQ(results.counts(slot(0)).flagged, 1);
  EXPECT_THAT(results.flagged(), ElementsAre(Field(&FlaggedRow::loop_name, "a")));
  EXPECT_THAT(results.loops(), SizeIs(1));
  EXPECT_THAT(report().flagged(), ElementsAre(Field(&FlaggedRow::loop_name, "b")));
}

TEST_F(ReportDatabaseTest, AReadersRightsAreEnough) {
  database->make_roles();
  migrate(settings_for(*database));
  tell({{.loop = "a"}, {.loop = "b"}});
  oscillate("a", "b");
  ReportDatabase results(settings_for(*database, database->make_login("loopscope_reader")));
  EXPECT_EQ(results.counts(slot(0)).flagged, 1);
  EXPECT_THAT(results.flagged(), SizeIs(1));
  EXPECT_THAT(results.history(id("a"), slot(0)), SizeIs(1));
  EXPECT_THAT(results.repairs(slot(0)), IsEmpty());
  EXPECT_THAT(results.plant_oscillations(), SizeIs(1));
  EXPECT_FALSE(results.data_problems(id("a")).empty());
  EXPECT_TRUE(results.latest("b"));
  EXPECT_THAT(results.loops(), SizeIs(2));
  EXPECT_THAT(results.what_if(0.5, 0, 0.1), SizeIs(1));
}

TEST_F(ReportDatabaseTest, AnErrorEndsTheView) {
  add_loops({"a"});
  ReportDatabase results = report();
  EXPECT_THAT(results.loops(), SizeIs(1));
  database->execute(
      "SELECT pg_terminate_backend(pid) FROM pg_stat_activity"
      " WHERE datname = current_database() AND application_name LIKE 'loopscope/%'");
  try {
    static_cast<void>(results.loops());
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::reconnect);
  }
  EXPECT_THROW(static_cast<void>(results.now_us()), DatabaseError);
}

}  // namespace
}  // namespace loopscope::storage
