#include <gmock/gmock.h>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/reports/report_database.hpp"
#include "tests/storage/results/views_fixture.hpp"

/// What keeps faults from flagged_loop, and that this is shown.
namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class HidingTest : public ViewsTest {
 protected:
  [[nodiscard]] std::int64_t id(const std::string& loop) const {
    return std::stoll(value("SELECT loop_id FROM loopscope.loop WHERE name = '" + loop + "'"));
  }
  [[nodiscard]] std::vector<HiddenRow> hidden_of(std::int64_t loop_id) const {
    std::vector<HiddenRow> said;
    for (const HiddenLoopRow& row : ReportDatabase(settings_for(*database)).hidden())
      if (row.loop_id == loop_id) said.push_back(row.said);
    return said;
  }
  [[nodiscard]] PlantMember member(const std::string& loop, const std::string& role) const {
    return {id(loop), role, 0.5, 1.0, 2.0};
  }
  /// `a` swings `b` and the cascade slave `c`.
  [[nodiscard]] PlantEvent event() const {
    return {40.0,
            id("a"),
            "a leads",
            1e-6,
            {member("a", "source"), member("b", "victim"), member("c", "cascade_slave")}};
  }
  [[nodiscard]] ReportDatabase report() const { return ReportDatabase(settings_for(*database)); }
  /// On every loop.
  void work_done(const std::string& at) const {
    database->execute(
        "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
        " SELECT loop_id, '" +
        at + "', 'valve', 'new packing' FROM loopscope.loop");
  }
  void round(int hours, std::vector<PlantEvent> events) const {
    PlantRounds(settings_for(*database)).store({slot(hours), 1, 9, 3, std::move(events)});
  }
};

TEST_F(HidingTest, VictimsLeaveTheListAndNobodyElse) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}, {.loop = "d"}});
  EXPECT_THAT(flagged(), UnorderedElementsAre("a", "b", "c", "d"));
  PlantEvent shared = event();
  shared.members.push_back(member("d", "member"));
  round(1, {shared});
  EXPECT_THAT(flagged(), UnorderedElementsAre("a", "d"));
  EXPECT_EQ(database->rows("SELECT loop_name, plant_oscillation_number FROM loopscope.flagged_loop"
                           " ORDER BY loop_name"),
            (TextRows{{"a", "1"}, {"d", "NULL"}}));
  EXPECT_EQ(database->rows("SELECT loop_name, hidden_by, reason, source_loop_name,"
                           " plant_oscillation_number, author FROM loopscope.hidden_loop"
                           " ORDER BY loop_name"),
            (TextRows{{"b", "victim", "a leads", "a", "1", "NULL"},
                      {"c", "victim", "a leads", "a", "1", "NULL"}}));
}

TEST_F(HidingTest, ARoundWithoutAFindingReleasesThem) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  round(1, {event()});
  round(2, {});
  EXPECT_THAT(flagged(), UnorderedElementsAre("a", "b", "c"));
  round(1, {event()});
  EXPECT_THAT(flagged(), UnorderedElementsAre("a", "b", "c")) << "an older round changes nothing";
}

TEST_F(HidingTest, AnOldRoundHidesNoNewVerdict) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  round(1, {event()});
  tell({{.loop = "b", .slot_hours = 1 + 7 * 24}});
  EXPECT_THAT(flagged(), ElementsAre("a"));
  tell({{.loop = "b", .slot_hours = 2 + 7 * 24}});
  EXPECT_THAT(flagged(), UnorderedElementsAre("a", "b"));
}

TEST_F(HidingTest, WhoCausesOneIsNotExcusedByAnother) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  PlantEvent other = event();
  other.source_loop_id = id("b");
  other.members = {member("b", "source"), member("c", "victim")};
  round(1, {event(), other});
  EXPECT_THAT(flagged(), UnorderedElementsAre("a", "b"));
}

TEST_F(HidingTest, VictimsStayInTheFamilyWithoutRank) {
  // Alone p = 0.04 passes at 0.05; beside a certain one that is hidden it does not.
  tell({{.loop = "a"},
        {.loop = "b", .p = 1e-9, .oscillation_p = 1e-9},
        {.loop = "c", .code = core::diagnosis::VerdictCode::healthy},
        {.loop = "d", .p = 0.04, .oscillation_p = 0.04}});
  EXPECT_THAT(flagged(), UnorderedElementsAre("a", "b", "d"));
  round(1, {event()});
  EXPECT_THAT(flagged(), ElementsAre("a"));
}

TEST_F(HidingTest, WhatIsSuppressedByWhomAndUntilWhen) {
  tell({{.loop = "a"}});
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind, until, reason) SELECT loop_id,"
      " 'suppressed', now() + interval '1 h', 'shutdown' FROM loopscope.loop");
  EXPECT_EQ(database->rows("SELECT loop_name, code, hidden_by, reason, author = session_user,"
                           " until > now() FROM loopscope.hidden_loop"),
            (TextRows{{"a", "valve_stiction", "suppressed", "shutdown", "t", "t"}}));
  EXPECT_EQ(database->rows("SELECT loop_name, kind, state FROM loopscope.annotation_history"),
            (TextRows{{"a", "suppressed", "in_force"}}));
  database->execute("UPDATE loopscope.annotation SET withdrawn_at = now()");
  EXPECT_THAT(column("SELECT hidden_by FROM loopscope.hidden_loop"), IsEmpty());
  EXPECT_EQ(database->rows("SELECT state, withdrawn_by = session_user"
                           " FROM loopscope.annotation_history"),
            (TextRows{{"withdrawn", "t"}}));
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind, until, reason) SELECT loop_id,"
      " 'suppressed', now() - interval '1 s', 'shutdown' FROM loopscope.loop");
  EXPECT_EQ(database->rows("SELECT state FROM loopscope.annotation_history"
                           " WHERE withdrawn_by IS NULL"),
            (TextRows{{"ended"}}));
}

TEST_F(HidingTest, AnAnnotationAboutAnotherVerdictHidesNothing) {
  tell({{.loop = "a"}});
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind, code) SELECT loop_id, 'false_positive',"
      " 'tight_tuning' FROM loopscope.loop");
  EXPECT_THAT(column("SELECT hidden_by FROM loopscope.hidden_loop"), IsEmpty());
  EXPECT_THAT(flagged(), ElementsAre("a"));
}

TEST_F(HidingTest, AnAcknowledgedFaultIsBackWhenTheWorkDidNotMendIt) {
  tell({{.loop = "a"}});
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind, code) SELECT loop_id, 'acknowledged',"
      " 'valve_stiction' FROM loopscope.loop;"
      "UPDATE loopscope.annotation SET entered_at = '2026-01-01 01:30+00'");
  work_done("2026-01-01 01:00+00");
  tell({{.loop = "a", .slot_hours = 4}});
  EXPECT_THAT(flagged(), IsEmpty()) << "that work was done before it was acknowledged";
  work_done("2026-01-01 05:30+00");
  tell({{.loop = "a", .slot_hours = 6}});
  EXPECT_THAT(flagged(), IsEmpty()) << "that window began before the work was done";
  tell({{.loop = "a", .slot_hours = 8}});
  EXPECT_THAT(flagged(), ElementsAre("a"));
  EXPECT_THAT(column("SELECT state FROM loopscope.annotation_history"), ElementsAre("ended"));
}

TEST_F(HidingTest, VictimsAreBackWhenTheirSourceIsCalledFalse) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  round(1, {event()});
  const std::string said =
      "INSERT INTO loopscope.annotation (loop_id, kind, code) SELECT loop_id, 'false_positive', ";
  database->execute(said + "'tight_tuning' FROM loopscope.loop WHERE name = 'a'");
  EXPECT_THAT(flagged(), ElementsAre("a")) << "said of another verdict";
  database->execute(said + "'valve_stiction' FROM loopscope.loop WHERE name = 'a'");
  EXPECT_THAT(flagged(), UnorderedElementsAre("b", "c"));
}

TEST_F(HidingTest, IsToldOfEachLoop) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}, {.loop = "fine", .code = kHealthy}});
  round(1, {event()});
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind) SELECT loop_id, 'acknowledged'"
      " FROM loopscope.loop WHERE name IN ('b', 'fine')");
  EXPECT_THAT(hidden_of(id("a")), IsEmpty());
  EXPECT_THAT(hidden_of(id("fine")), IsEmpty()) << "there is nothing to hide";
  const std::vector<HiddenRow> hidden = hidden_of(id("b"));
  ASSERT_EQ(hidden.size(), 2U);
  EXPECT_EQ(hidden[0].hidden_by, "victim");
  EXPECT_EQ(hidden[0].plant_oscillation_number, 1);
  EXPECT_EQ(hidden[0].source_name, "a");
  EXPECT_EQ(hidden[0].author, "");
  EXPECT_EQ(hidden[1].hidden_by, "acknowledged");
  EXPECT_EQ(hidden[1].plant_oscillation_number, std::nullopt);
  EXPECT_EQ(hidden[1].author, value("SELECT session_user"));
  EXPECT_EQ(hidden[1].until_us, std::nullopt);
  EXPECT_GT(hidden[1].entered_us, slot(0));
}

TEST_F(HidingTest, WhatTheListItselfLeavesOutWasEnteredByNobody) {
  tell({{.loop = "a", .fault_probability = 0.6}});
  const std::vector<HiddenRow> hidden = hidden_of(id("a"));
  ASSERT_EQ(hidden.size(), 1U);
  EXPECT_EQ(hidden[0].hidden_by, "probability");
  EXPECT_EQ(hidden[0].entered_us, 0);
  EXPECT_EQ(hidden[0].author, "");
}

TEST_F(HidingTest, AnOldRoundNamesNoSource) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  round(1, {event()});
  EXPECT_EQ(report().latest("a")->plant_oscillation_number, 1);
  tell({{.loop = "a", .code = kHealthy, .slot_hours = 2}});
  EXPECT_EQ(report().latest("a")->plant_oscillation_number, std::nullopt) << "healthy by now";
  tell({{.loop = "a", .slot_hours = 2 + 7 * 24}});
  EXPECT_EQ(report().latest("a")->plant_oscillation_number, std::nullopt) << "a week later";
}

}  // namespace
}  // namespace loopscope::storage
