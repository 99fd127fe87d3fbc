#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "core/plant/list_by_odds.hpp"
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
        {.loop = "doubtful", .p = 1e-9, .fault_probability = 0.905},
        {.loop = "likely", .p = 1e-9, .fault_probability = 0.79},
        {.loop = "not rare", .p = 0.9, .oscillation_p = 0.9, .fault_probability = 0.99},
        {.loop = "fine",
         .code = VerdictCode::healthy,
         .nonlinear_p = 0.8,
         .oscillation_p = 0.9,
         .fault_probability = 0.1},
        {.loop = "of before", .p = 1e-9, .nonlinear_p = 1e-9}});
  connect().set_parameter("list_false_share", 0.04);
  EXPECT_THAT(flagged(), UnorderedElementsAre("sure", "a fact", "of before"));
  EXPECT_THAT(column("SELECT loop_name FROM loopscope.flagged_at(1)"),
              UnorderedElementsAre("sure", "a fact", "not rare", "of before"))
      << "by odds alone";
  connect().set_parameter("list_false_share", 0.15);
  EXPECT_THAT(flagged(), UnorderedElementsAre("sure", "a fact", "doubtful", "of before"))
      << "the sure ones lend no place to what is below list_least_probability";
}

TEST_F(FlaggedLoopTest, SeveralWindowsDecideWhetherAFaultIsProbable) {
  tell({{.loop = "a", .slot_hours = 1, .fault_probability = 0.999}});
  EXPECT_THAT(flagged(), ElementsAre("a"));
  tell({{.loop = "a", .slot_hours = 2, .fault_probability = 0.9}});
  EXPECT_THAT(flagged(), ElementsAre("a")) << "one doubtful window does not take it off";
  EXPECT_EQ(value("SELECT fault_probability > 0.98 FROM loopscope.flagged_loop"), "t");
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
  // The defaults among them.
  for (const auto& [share, least] : std::vector<std::pair<double, double>>{
           {0.0, 0.5}, {0.02, 0.8}, {0.08, 0.5}, {0.08, 0.9}, {0.2, 0.7}}) {
    connect().set_parameter("list_false_share", share);
    connect().set_parameter("list_least_probability", least);
    const std::vector<bool> listed = core::plant::list_by_odds(probability, share, least);
    std::vector<std::string> expected;
    for (std::size_t k = 0; k < listed.size(); ++k)
      if (listed[k]) expected.push_back(stories[k].loop);
    EXPECT_THAT(flagged(), testing::UnorderedElementsAreArray(expected)) << share << " " << least;
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
