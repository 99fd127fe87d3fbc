#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "core/diagnosis/odds/combined_odds.hpp"
#include "core/plant/list_by_odds.hpp"
#include "storage/results/plant/plant_rounds.hpp"
#include "tests/storage/results/views_fixture.hpp"

/// What comes onto the list over time, and stays: list_questions(), hidden_loop.
namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::ElementsAre;
using testing::IsEmpty;

/// What is told of loop "a" and of one that keeps the list company.
class StandingListTest : public ViewsTest {
 protected:
  void tell_probability(int hours, double fault_probability) {
    tell({{.loop = "a", .slot_hours = hours, .fault_probability = fault_probability}});
    // The window alone: what several say together is not asked here.
    database->execute("UPDATE loopscope.analysis SET combined_probabilities = NULL");
  }
  void note() { static_cast<void>(PlantRounds(settings_for(*database)).announce_flags()); }
};

TEST_F(StandingListTest, EntersAtOneRateAndLeavesAtALooserOne) {
  tell_probability(1, 0.9);
  EXPECT_THAT(flagged(), IsEmpty()) << "10 % of doubt are more than 2";
  tell_probability(2, 0.99);
  EXPECT_THAT(flagged(), ElementsAre("a"));
  note();
  for (const double probability : {0.85, 0.97, 0.81}) {
    tell_probability(3, probability);
    note();
    EXPECT_THAT(flagged(), ElementsAre("a")) << probability;
  }
  EXPECT_EQ(value("SELECT since = (SELECT min(slot_end) FROM loopscope.flag_history)"
                  " FROM loopscope.flagged_loop"),
            "f")
      << "the run of the verdict is older than the stay";
  tell_probability(4, 0.75);
  EXPECT_THAT(flagged(), IsEmpty()) << "25 % are more than 20";
  note();
  tell_probability(5, 0.9);
  EXPECT_THAT(flagged(), IsEmpty()) << "it has to enter again";
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.flag_history"), "1");
}

TEST_F(StandingListTest, SureFaultsKeepNoLoopThatIsMoreLikelySound) {
  for (int k = 0; k < 20; ++k)
    tell({{.loop = "sure" + std::to_string(k), .fault_probability = 0.999}});
  tell_probability(1, 0.99);
  note();
  const auto stays = [&](int hour, double probability) {
    tell_probability(hour, probability);
    note();
    return value("SELECT count(*) FROM loopscope.flagged_loop WHERE loop_name = 'a'") == "1";
  };
  EXPECT_TRUE(stays(2, 0.51));
  EXPECT_FALSE(stays(3, 0.49)) << "the mean of 1 - fault_probability is 0.025";
}

TEST_F(StandingListTest, AWindowThatCannotBeJudgedTakesNothingOff) {
  tell_probability(1, 0.99);
  note();
  tell({{.loop = "a", .code = VerdictCode::insufficient_data, .slot_hours = 2, .usable = false}});
  EXPECT_EQ(database->rows("SELECT loop_name, code, slot_end FROM loopscope.flagged_loop"),
            (TextRows{{"a", "valve_stiction", "2026-01-01 01:00:00+00"}}));
  tell({{.loop = "a", .code = VerdictCode::not_controlling, .slot_hours = 3}});
  EXPECT_THAT(flagged(), IsEmpty()) << "nobody controls it";
}

TEST_F(StandingListTest, OfTheNewestWindowThatNamesAFault) {
  tell_probability(1, 0.99);
  note();
  tell({{.loop = "a", .code = VerdictCode::healthy, .slot_hours = 2, .fault_probability = 0.85}});
  database->execute("UPDATE loopscope.analysis SET combined_probabilities = NULL");
  EXPECT_EQ(database->rows("SELECT code, round(fault_probability::numeric, 2)"
                           " FROM loopscope.flagged_loop"),
            (TextRows{{"valve_stiction", "0.85"}}));
}

/// Windows are of 4096 s: those of hours 1 and 2 share samples.
TEST_F(StandingListTest, FromASecondWindowOnThatSharesNoSampleOddsAloneDecide) {
  const auto window = [&](int hour) {
    tell({{.loop = "a",
           .p = 0.9,
           .oscillation_p = 0.9,
           .slot_hours = hour,
           .fault_probability = 0.999}});
  };
  for (const auto& [hour, listed] : {std::pair{1, 0U}, {2, 0U}, {3, 1U}}) {
    window(hour);
    EXPECT_EQ(flagged().size(), listed) << hour;
  }
  connect().set_parameter("list_enough_windows", 3.0);
  EXPECT_THAT(flagged(), IsEmpty());
  EXPECT_EQ(value("SELECT hidden_by FROM loopscope.hidden_loop"), "chance");
  window(4);
  EXPECT_THAT(flagged(), ElementsAre("a"));
}

TEST_F(StandingListTest, AWindowThatIsForgottenLendsTheNewestNothing) {
  const int memory_h =
      static_cast<int>(core::diagnosis::longest_memory_windows() * 4095.0 / 3600.0);
  for (const auto& [loop, hour] : {std::pair{"near", 1 + memory_h}, {"far", 2 + memory_h}})
    for (const int slot : {1, hour})
      tell({{.loop = loop,
             .p = 0.9,
             .oscillation_p = 0.9,
             .slot_hours = slot,
             .fault_probability = 0.999}});
  EXPECT_THAT(flagged(), ElementsAre("near"));
}

TEST_F(StandingListTest, AnAnnotationOfWhatTheListSaysEndsTheStay) {
  tell_probability(1, 0.99);
  note();
  tell({{.loop = "a", .code = VerdictCode::healthy, .slot_hours = 2, .fault_probability = 0.85}});
  database->execute("UPDATE loopscope.analysis SET combined_probabilities = NULL");
  EXPECT_THAT(flagged(), ElementsAre("a"));
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind, code)"
      " SELECT loop_id, 'false_positive', 'valve_stiction' FROM loopscope.loop");
  EXPECT_THAT(flagged(), IsEmpty());
  EXPECT_EQ(value("SELECT hidden_by FROM loopscope.hidden_loop"), "false_positive");
  EXPECT_EQ(PlantRounds(settings_for(*database)).announce_flags().ended, 1U);
  EXPECT_EQ(value("SELECT ended_by FROM loopscope.flag_history"), "annotation");
}

TEST_F(StandingListTest, AStayOutlivesTheRowsThatItBeganWith) {
  tell_probability(1, 0.99);
  note();
  tell({{.loop = "a", .code = VerdictCode::insufficient_data, .slot_hours = 2, .usable = false}});
  database->execute(
      "DELETE FROM loopscope.verdict WHERE code = 'valve_stiction';"
      "DELETE FROM loopscope.analysis WHERE usable");
  EXPECT_EQ(database->rows("SELECT loop_name, code, summary FROM loopscope.flagged_loop"),
            (TextRows{{"a", "valve_stiction", "The valve sticks."}}));
}

TEST_F(StandingListTest, StaysAreThoseOfCore) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform;
  std::vector<Story> stories;
  std::vector<double> probability;
  for (int k = 0; k < 40; ++k)
    stories.push_back({.loop = "L" + std::to_string(k), .fault_probability = 0.9999});
  tell(stories);
  note();
  for (Story& story : stories) {
    const double value = std::pow(uniform(random), 0.3);
    story.slot_hours = 2;
    story.fault_probability = value;
    probability.push_back(1.0 - static_cast<double>(static_cast<float>(1.0 - value)));
  }
  tell(stories);
  database->execute("UPDATE loopscope.analysis SET combined_probabilities = NULL");
  for (const auto& [share, leave] :
       std::vector<std::pair<double, double>>{{0.05, 0.5}, {0.15, 0.5}, {0.3, 0.7}, {0.5, 0.1}}) {
    connect().set_parameter("list_leave_share", share);
    connect().set_parameter("list_leave_probability", leave);
    const std::vector<bool> stays =
        core::plant::list_by_odds(probability, share, std::max(leave, 0.3));
    std::vector<std::string> expected;
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (stays[k]) expected.push_back(stories[k].loop);
    EXPECT_THAT(flagged(), testing::UnorderedElementsAreArray(expected)) << share;
  }
}

TEST_F(StandingListTest, ADeadMeasurementIsFirst) {
  tell({{.loop = "sticks", .harris = 0.01},
        {.loop = "dead", .code = VerdictCode::sensor_fault, .confidence = 0.9}});
  EXPECT_THAT(flagged(), ElementsAre("sticks", "dead"));
  database->execute(
      "UPDATE loopscope.loop SET importance = 0.01 WHERE name = 'dead';"
      "UPDATE loopscope.analysis SET flags = '{pv_frozen,pv_dead}' WHERE loop_id ="
      " (SELECT loop_id FROM loopscope.loop WHERE name = 'dead')");
  EXPECT_THAT(flagged(), ElementsAre("dead", "sticks"));
}

TEST_F(StandingListTest, WhatIsProbableAndNotListedCanBeFound) {
  tell({{.loop = "unsure", .fault_probability = 0.4},
        {.loop = "fine", .code = VerdictCode::healthy, .fault_probability = 0.1},
        {.loop = "likely", .code = VerdictCode::healthy, .fault_probability = 0.45},
        {.loop = "common", .p = 0.9, .oscillation_p = 0.9, .fault_probability = 0.999},
        {.loop = "no test", .p = 1.0, .fault_probability = 0.999}});
  EXPECT_EQ(database->rows("SELECT loop_name, hidden_by, cause, round(probability::numeric, 2)"
                           " FROM loopscope.hidden_loop ORDER BY 1"),
            (TextRows{{"common", "chance", "process_change", "1.00"},
                      {"likely", "probability", "process_change", "0.45"},
                      {"no test", "chance", "process_change", "1.00"},
                      {"unsure", "probability", "process_change", "0.40"}}));
  EXPECT_EQ(value("SELECT reason FROM loopscope.hidden_loop WHERE loop_name = 'unsure'"),
            "not sure enough for the list (probability 0.40)");
  EXPECT_EQ(value("SELECT reason FROM loopscope.hidden_loop WHERE loop_name = 'no test'"),
            "no test of this window shows it: its probability alone decides once more windows have "
            "been read");
}

TEST_F(StandingListTest, AProbableCauseIsFoundWhateverTheNewestWindowIsCalled) {
  tell({{.loop = "a", .code = VerdictCode::sluggish_tuning, .fault_probability = 0.41}});
  database->execute(
      "UPDATE loopscope.analysis SET combined_probabilities = NULL;"
      "UPDATE loopscope.verdict SET cause_probabilities[12] = 0.08");
  EXPECT_EQ(database->rows("SELECT code, cause, round(probability::numeric, 2)"
                           " FROM loopscope.hidden_loop"),
            (TextRows{{"sluggish_tuning", "process_change", "0.41"}}));
}

TEST_F(StandingListTest, ALoopThatWouldFillTheListIsToldSo) {
  tell({{.loop = "a", .fault_probability = 0.93}});
  EXPECT_EQ(
      value("SELECT reason FROM loopscope.hidden_loop"),
      "a fault is probable (0.93), but the surer ones fill the list: with this loop more than 2 % "
      "of the loops on it would be expected to have no fault");
}

}  // namespace
}  // namespace loopscope::storage
