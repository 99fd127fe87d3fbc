#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "core/plant/list_by_odds.hpp"
#include "storage/results/plant_rounds.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class FlaggedLoopTest : public ViewsTest {
 protected:
  void annotate(const std::string& loop, const std::string& columns, const std::string& values) {
    database->execute("INSERT INTO loopscope.annotation (loop_id, " + columns +
                      ") SELECT loop_id, " + values + " FROM loopscope.loop WHERE name = '" + loop +
                      "'");
  }
};

TEST_F(FlaggedLoopTest, FaultsOfEnabledLoopsWithEnoughConfidence) {
  tell({{.loop = "sticky"},
        {.loop = "fine", .code = VerdictCode::healthy},
        {.loop = "dead", .code = VerdictCode::insufficient_data},
        {.loop = "unsure", .confidence = 0.29},
        {.loop = "off"}});
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"off"}, false);
  EXPECT_THAT(flagged(), ElementsAre("sticky"));
  connect().set_parameter("min_confidence", 0.2);
  EXPECT_THAT(flagged(), UnorderedElementsAre("sticky", "unsure"));
}

TEST_F(FlaggedLoopTest, NewestVerdictCounts) {
  tell({{.loop = "mended", .slot_hours = 1},
        {.loop = "mended", .code = VerdictCode::healthy, .slot_hours = 2}});
  EXPECT_THAT(flagged(), IsEmpty());
}

TEST_F(FlaggedLoopTest, RanksByTheProductOfItsFactors) {
  // severity = 1 - harris: stiction 0.8 x 1.0, twice as important tuning 0.5 x 2 x 0.7 = 0.7,
  // sure disturbance 0.9 x 0.5 = 0.45, unsure stiction 0.8 x 0.5 = 0.4.
  tell({{.loop = "unsure stiction", .confidence = 0.5, .harris = 0.2},
        {.loop = "disturbance", .code = VerdictCode::external_disturbance, .harris = 0.1},
        {.loop = "stiction", .harris = 0.2},
        {.loop = "tuning", .code = VerdictCode::tight_tuning, .harris = 0.5}});
  database->execute("UPDATE loopscope.loop SET importance = 2 WHERE name = 'tuning'");
  EXPECT_THAT(flagged(), ElementsAre("stiction", "tuning", "disturbance", "unsure stiction"));
  EXPECT_EQ(value("SELECT bool_and(abs(score - severity * importance * kind_weight * confidence)"
                  " < 1e-12) FROM loopscope.flagged_loop"),
            "t");
  EXPECT_EQ(value("SELECT round(score::numeric, 3) FROM loopscope.flagged_loop WHERE rank = 2"),
            "0.700");
}

TEST_F(FlaggedLoopTest, VerdictsThatRestOnATestHaveToPassTheControl) {
  tell({{.loop = "fact"},
        {.loop = "certain", .p = 1e-9, .oscillation_p = 1e-9},
        {.loop = "doubtful", .p = 0.04, .nonlinear_p = 0.04},
        {.loop = "fine", .code = VerdictCode::healthy, .nonlinear_p = 0.8}});
  EXPECT_THAT(flagged(), UnorderedElementsAre("fact", "certain"));
  connect().set_parameter("false_discovery_rate", 0.1);
  EXPECT_THAT(flagged(), UnorderedElementsAre("fact", "certain", "doubtful"));
  connect().set_parameter("false_discovery_dependence", 1.0);
  EXPECT_THAT(flagged(), UnorderedElementsAre("fact", "certain"));
}

TEST_F(FlaggedLoopTest, WhereCausesWereWeighedFaultsHaveToBeProbableAsWell) {
  tell({{.loop = "sure", .p = 1e-9, .fault_probability = 0.99},
        {.loop = "a fact", .fault_probability = 0.95},
        {.loop = "doubtful", .p = 1e-9, .fault_probability = 0.8},
        {.loop = "not rare", .p = 0.9, .oscillation_p = 0.9, .fault_probability = 0.99},
        {.loop = "fine",
         .code = VerdictCode::healthy,
         .nonlinear_p = 0.8,
         .oscillation_p = 0.9,
         .fault_probability = 0.1},
        {.loop = "of before", .p = 1e-9, .nonlinear_p = 1e-9}});
  connect().set_parameter("list_false_share", 0.05);
  EXPECT_THAT(flagged(), UnorderedElementsAre("sure", "a fact", "of before"));
  EXPECT_THAT(column("SELECT loop_name FROM loopscope.flagged_at(1)"),
              UnorderedElementsAre("sure", "a fact", "not rare", "of before"))
      << "by odds alone";
  connect().set_parameter("list_false_share", 0.1);
  EXPECT_THAT(flagged(), UnorderedElementsAre("sure", "a fact", "doubtful", "of before"));
}

TEST_F(FlaggedLoopTest, SeveralWindowsDecideWhetherAFaultIsProbable) {
  tell({{.loop = "a", .slot_hours = 1, .fault_probability = 0.999}});
  EXPECT_THAT(flagged(), ElementsAre("a"));
  tell({{.loop = "a", .slot_hours = 2, .fault_probability = 0.9}});
  EXPECT_THAT(flagged(), ElementsAre("a")) << "one doubtful window does not take it off";
  EXPECT_EQ(value("SELECT fault_probability > 0.98 FROM loopscope.flagged_loop"), "t");
}

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

TEST_F(StandingListTest, AfterTwoWindowsOddsAloneDecide) {
  tell({{.loop = "a", .p = 0.9, .oscillation_p = 0.9, .fault_probability = 0.999}});
  EXPECT_THAT(flagged(), IsEmpty());
  EXPECT_EQ(value("SELECT hidden_by FROM loopscope.hidden_loop"), "chance");
  for (const auto& [windows, listed] : {std::pair{"1.9", 0U}, {"2.1", 1U}}) {
    database->execute(std::string("UPDATE loopscope.analysis SET combined_windows = '{0.5,") +
                      windows + "}'");
    EXPECT_EQ(flagged().size(), listed) << windows;
  }
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
  for (const double share : {0.05, 0.15, 0.3, 0.5}) {
    connect().set_parameter("list_leave_share", share);
    const std::vector<bool> stays = core::plant::stay_by_odds(probability, share, 0.3);
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
        {.loop = "common", .p = 0.9, .oscillation_p = 0.9, .fault_probability = 0.999}});
  EXPECT_EQ(database->rows("SELECT loop_name, hidden_by, cause, round(probability::numeric, 2)"
                           " FROM loopscope.hidden_loop ORDER BY 1"),
            (TextRows{{"common", "chance", "process_change", "1.00"},
                      {"likely", "probability", "process_change", "0.45"},
                      {"unsure", "probability", "process_change", "0.40"}}));
  EXPECT_EQ(value("SELECT reason FROM loopscope.hidden_loop WHERE loop_name = 'unsure'"),
            "not sure enough for the list (probability 0.40)");
}

TEST_F(FlaggedLoopTest, TheListIsThatOfCore) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  std::vector<Story> stories;
  std::vector<double> probability;
  for (int k = 0; k < 40; ++k) {
    // Ties, too.
    const double value = k % 3 == 0 ? 0.9 : std::pow(uniform(random), 0.2);
    stories.push_back({.loop = "L" + std::to_string(k), .fault_probability = value});
    // As it is stored, in four bytes.
    probability.push_back(1.0 - static_cast<double>(static_cast<float>(1.0 - value)));
  }
  tell(stories);
  for (const double share : {0.0, 0.03, 0.08, 0.2}) {
    connect().set_parameter("list_false_share", share);
    const std::vector<bool> listed = core::plant::list_by_odds(probability, share);
    std::vector<std::string> expected;
    for (std::size_t k = 0; k < listed.size(); ++k)
      if (listed[k]) expected.push_back(stories[k].loop);
    EXPECT_THAT(flagged(), testing::UnorderedElementsAreArray(expected)) << share;
  }
}

TEST_F(FlaggedLoopTest, AnnotationsHideWhileTheyHold) {
  tell({{.loop = "a"}});
  annotate("a", "kind, until, reason", "'suppressed', now() - interval '1 s', 'shutdown'");
  EXPECT_THAT(flagged(), ElementsAre("a")) << "its time is over";
  annotate("a", "kind, until, reason", "'suppressed', now() + interval '1 h', 'shutdown'");
  EXPECT_THAT(flagged(), IsEmpty());
  database->execute("UPDATE loopscope.annotation SET withdrawn_at = now()");
  EXPECT_THAT(flagged(), ElementsAre("a"));
  annotate("a", "kind, code", "'false_positive', 'tight_tuning'");
  EXPECT_THAT(flagged(), ElementsAre("a")) << "about another verdict";
  annotate("a", "kind, code", "'acknowledged', 'valve_stiction'");
  EXPECT_THAT(flagged(), IsEmpty());
}

TEST_F(FlaggedLoopTest, SuppressionNeedsAnEndAndAReason) {
  tell({{.loop = "a"}});
  EXPECT_THROW(annotate("a", "kind", "'suppressed'"), std::runtime_error);
  EXPECT_THROW(annotate("a", "kind, until", "'suppressed', now()"), std::runtime_error);
  EXPECT_THROW(annotate("a", "kind, until, reason", "'suppressed', 'infinity', 'x'"),
               std::runtime_error);
  EXPECT_THROW(annotate("a", "kind", "'ignored'"), std::runtime_error);
}

}  // namespace
}  // namespace loopscope::storage
