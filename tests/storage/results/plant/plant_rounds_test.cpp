#include "storage/results/plant/plant_rounds.hpp"

#include <gmock/gmock.h>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

class PlantRoundsTest : public ViewsTest {
 protected:
  void SetUp() override {
    ViewsTest::SetUp();
    if (!database) return;
    add_loops({"a", "b", "c"});
    for (const auto& row : database->rows("SELECT loop_id FROM loopscope.loop ORDER BY name"))
      ids.push_back(std::stoll(row[0]));
  }
  [[nodiscard]] PlantRounds plant() const { return PlantRounds(settings_for(*database)); }
  [[nodiscard]] PlantEvent event(double period_s, std::size_t members) const {
    PlantEvent found{period_s, ids[0], "a leads", 1e-6, {}};
    for (std::size_t k = 0; k < members; ++k) {
      const auto nth = static_cast<double>(k);
      found.members.push_back({ids[k], k == 0 ? "source" : "victim", 0.5, 3.0 * nth, 2.0 - nth});
    }
    return found;
  }
  [[nodiscard]] TextRows current() const {
    return database->rows(
        "SELECT number, period_s, source_loop_name, cardinality(loop_ids)"
        " FROM loopscope.current_plant_oscillation ORDER BY number");
  }
  std::vector<std::int64_t> ids;
};

TEST_F(PlantRoundsTest, WritesARoundWithTheLargestEventFirst) {
  plant().store({slot(1), 1, 30, 5, {event(40, 2), event(90, 3)}});
  EXPECT_EQ(current(), (TextRows{{"1", "90", "a", "3"}, {"2", "40", "a", "2"}}));
  EXPECT_EQ(database->rows("SELECT loops, oscillating, events FROM loopscope.newest_plant_round"),
            (TextRows{{"30", "5", "2"}}));
  EXPECT_EQ(database->rows("SELECT loop_name, role, strength, lag_s, score, is_source, is_current"
                           " FROM loopscope.plant_oscillation_member WHERE number = 1"
                           " ORDER BY lag_s"),
            (TextRows{{"a", "source", "0.5", "0", "2", "t", "t"},
                      {"b", "victim", "0.5", "3", "1", "f", "t"},
                      {"c", "victim", "0.5", "6", "0", "f", "t"}}));
}

TEST_F(PlantRoundsTest, ARoundWrittenAgainReplacesItself) {
  PlantRounds rounds(settings_for(*database));
  rounds.store({slot(1), 1, 30, 5, {event(40, 2), event(90, 3)}});
  PlantEvent outside = event(50, 2);
  outside.source_loop_id.reset();
  outside.p.reset();
  for (PlantMember& member : outside.members) member = {member.loop_id, "member", 0.5, 0.0, {}};
  rounds.store({slot(1), 1, 30, 2, {outside}});
  EXPECT_EQ(current(), (TextRows{{"1", "50", "NULL", "2"}}));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.plant_oscillation_member"), "2")
      << "nor is the second event of the first writing shown as a former one";
  EXPECT_EQ(value("SELECT bool_and(score IS NULL AND role = 'member')"
                  " FROM loopscope.plant_oscillation_member"),
            "t");
}

TEST_F(PlantRoundsTest, TheNewestSlotHoldsWhateverTheOrderOfWriting) {
  plant().store({slot(2), 1, 30, 5, {event(40, 2)}});
  plant().store({slot(1), 1, 30, 5, {event(90, 3)}});
  EXPECT_EQ(current(), (TextRows{{"1", "40", "a", "2"}}));
  plant().store({slot(2), 2, 30, 5, {}});
  EXPECT_THAT(current(), IsEmpty()) << "a newer algorithm's word";
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.plant_oscillation_member WHERE is_current"), "0");
}

TEST_F(PlantRoundsTest, ARoundOfAClockAheadNeitherHoldsNorPutsOffTheNext) {
  tell({{.loop = "a"}});
  plant().store({slot(1), 1, 30, 5, {event(40, 2)}});
  plant().store({slot(2), 1, 30, 5, {event(90, 3)}});
  database->execute(
      "UPDATE loopscope.plant_oscillation SET slot_end = now() + interval '30 days'"
      " WHERE slot_end = '2026-01-01 02:00+00';"
      "UPDATE loopscope.plant_round SET slot_end = now() + interval '30 days',"
      " found_at = now() + interval '30 days' WHERE slot_end = '2026-01-01 02:00+00';"
      "UPDATE loopscope.plant_round SET found_at = now() - interval '1 day'"
      " WHERE slot_end = '2026-01-01 01:00+00'");
  EXPECT_EQ(current(), (TextRows{{"1", "40", "a", "2"}}));
  EXPECT_EQ(plant().take_turn(3600, "host/1", 60).wait_s, 0.0);
}

TEST_F(PlantRoundsTest, AllOrNothing) {
  PlantEvent lonely = event(40, 1);
  EXPECT_THROW(plant().store({slot(1), 1, 30, 5, {event(90, 3), lonely}}), DatabaseError);
  PlantEvent misnamed = event(40, 2);
  misnamed.members[0].role = "culprit";
  EXPECT_THROW(plant().store({slot(1), 1, 30, 5, {misnamed}}), DatabaseError);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.plant_round"), "0");
}

TEST_F(PlantRoundsTest, NothingToDoBeforeTheFirstAnalysis) {
  const PlantTurn turn = plant().take_turn(0, "host/1", 60);
  EXPECT_EQ(turn.wait_s, std::nullopt);
  EXPECT_EQ(turn.holder, "");
  EXPECT_EQ(plant().newest_slot_us(), std::nullopt);
}

TEST_F(PlantRoundsTest, ATurnWithoutARoundCanBeGivenBack) {
  tell({{.loop = "a"}});
  PlantRounds first(settings_for(*database)), second(settings_for(*database));
  EXPECT_EQ(first.take_turn(3600, "host/1", 60).wait_s, 0.0);
  first.give_turn_back();
  EXPECT_EQ(second.take_turn(3600, "host/2", 60).wait_s, 0.0);
  first.give_turn_back();
  EXPECT_EQ(first.take_turn(3600, "host/1", 60).holder, "host/2") << "of another's it gives none";
}

TEST_F(PlantRoundsTest, OneAtATimeMakesARoundAndOnlyWhenItIsDue) {
  tell({{.loop = "a"}});
  PlantRounds first(settings_for(*database)), second(settings_for(*database));
  EXPECT_EQ(first.take_turn(3600, "host/1", 60).wait_s, 0.0);
  const PlantTurn refused = second.take_turn(3600, "host/2", 60);
  EXPECT_EQ(refused.wait_s, std::nullopt);
  EXPECT_EQ(refused.holder, "host/1");
  EXPECT_EQ(first.take_turn(3600, "host/1", 60).wait_s, 0.0) << "it is its own";
  EXPECT_EQ(first.newest_slot_us(), slot(1));
  first.store({slot(1), 1, 30, 0, {}});
  for (PlantRounds* rounds : {&first, &second}) {
    const PlantTurn turn = rounds->take_turn(3600, "host/3", 60);
    ASSERT_TRUE(turn.wait_s);
    EXPECT_NEAR(*turn.wait_s, 3600.0, 60.0) << "made just now";
    EXPECT_EQ(turn.holder, "");
  }
  EXPECT_EQ(second.take_turn(0, "host/2", 60).wait_s, 0.0) << "given back with the round";
  EXPECT_EQ(first.take_turn(0, "host/1", 60).holder, "host/2");
}

TEST_F(PlantRoundsTest, WhoeverEndsGivesTheTurnBack) {
  tell({{.loop = "a"}});
  EXPECT_EQ(plant().take_turn(0, "host/1", 60).wait_s, 0.0);
  EXPECT_EQ(plant().take_turn(0, "host/2", 60).wait_s, 0.0);
}

TEST_F(PlantRoundsTest, TheTurnOfAWorkerThatDiedEnds) {
  tell({{.loop = "a"}});
  database->execute(
      "UPDATE loopscope.task_lease SET owner = 'gone/1', until = now() + interval '20 s',"
      " hold_s = 60 WHERE task = 'plant_round'");
  EXPECT_EQ(plant().take_turn(0, "host/1", 60).holder, "gone/1");
  database->execute("UPDATE loopscope.task_lease SET until = now() WHERE task = 'plant_round'");
  EXPECT_EQ(plant().take_turn(0, "host/1", 60).wait_s, 0.0);
}

TEST_F(PlantRoundsTest, ATurnOfAClockThatWasAheadDoesNotHold) {
  tell({{.loop = "a"}});
  database->execute(
      "UPDATE loopscope.task_lease SET owner = 'gone/1', until = now() + interval '30 days',"
      " hold_s = 60 WHERE task = 'plant_round'");
  EXPECT_EQ(plant().take_turn(0, "host/1", 60).wait_s, 0.0);
}

TEST_F(PlantRoundsTest, ComparesEnabledLoopsWithAUsableWindow) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c", .usable = false}, {.loop = "d"}});
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"b"}, false);
  const std::vector<PlantCandidate> loops = plant().candidates(slot(1), 9);
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[0].loop.name, "a");
  EXPECT_EQ(loops[0].loop.pv_tag, "a.PV");
  EXPECT_EQ(loops[0].slot_end_us, slot(1));
  EXPECT_TRUE(loops[0].oscillating);
  EXPECT_EQ(loops[0].verdict.code, core::diagnosis::VerdictCode::valve_stiction);
  EXPECT_EQ(loops[1].loop.name, "d");
  EXPECT_EQ(plant().candidates(slot(1), 1).size(), 1U);
  EXPECT_THAT(plant().candidates(slot(100), 9), IsEmpty()) << "loops that were left long ago";
}

TEST_F(PlantRoundsTest, AWorkersRightsAreEnough) {
  database->make_roles();
  migrate(settings_for(*database));
  tell({{.loop = "a"}});
  PlantRounds worker(settings_for(*database, database->make_login("loopscope_worker")));
  EXPECT_EQ(worker.take_turn(3600, "host/1", 60).wait_s, 0.0);
  worker.store({slot(1), 1, 30, 5, {event(40, 2)}});
  worker.store({slot(1), 1, 30, 5, {event(90, 3)}});
  EXPECT_THAT(worker.announce_flags().flagged, ElementsAre(Field(&FlagNotice::loop_name, "a")));
  EXPECT_EQ(worker.candidates(slot(1), 9).size(), 1U);
}

}  // namespace
}  // namespace loopscope::storage
