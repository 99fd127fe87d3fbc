#include "core/diagnosis/valve_words.hpp"

#include <gtest/gtest.h>

#include "core/diagnosis/evidence/figure.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

Evidence evidence_of_band(model::EffectKind effect, double band) {
  model::Step step = clear_step(effect);
  step.parameters = {{"S", "%", band, {}, {}}};
  Evidence evidence = evidence_with(explanation_of({step}));
  evidence.op_in_percent = true;
  return evidence;
}

TEST(ValveWords, TheStepsOfTheTestFitTheBand) {
  const auto action = [](double band) {
    return stroke_test_action(evidence_of_band(model::EffectKind::valve_stiction, band));
  };
  EXPECT_EQ(action(4.2),
            "Check in the field: put the controller in manual, step the output by about 1 % at a "
            "time (a quarter of the 4.2 % found) and watch when the stem moves; then packing, "
            "actuator and positioner.");
  EXPECT_NE(action(9.0).find("by about 2 % at a time"), std::string::npos);
  EXPECT_NE(action(1.3).find("by about 0.3 % at a time"), std::string::npos);
  EXPECT_NE(action(0.2).find("by about 0.1 % at a time"), std::string::npos);
}

TEST(ValveWords, WithoutABandInPercentTheUsualStepIsSaid) {
  const std::string usual(catalogue_entry(VerdictCode::valve_stiction).action);
  Evidence evidence = evidence_of_band(model::EffectKind::valve_stiction, 4.0);
  evidence.op_in_percent = false;
  EXPECT_EQ(stroke_test_action(evidence), usual);
  evidence = evidence_of_band(model::EffectKind::load_step, 4.0);
  EXPECT_EQ(stroke_test_action(evidence), usual);
  EXPECT_EQ(stroke_test_action(quiet_evidence()), usual);
}

/// "It sticks" and "it has dead band" in one finding contradict each other.
TEST(ValveWords, DeadBandFoundInALoopThatSticksIsSaid) {
  const Evidence band = evidence_of_band(model::EffectKind::valve_deadband, 5.0);
  EXPECT_EQ(valve_summary(VerdictCode::valve_stiction, band),
            "Hysteresis of the valve keeps the loop cycling: it sticks or has dead band, a stroke "
            "test tells which.");
  EXPECT_EQ(valve_summary(VerdictCode::valve_deadband, band), "");
  EXPECT_EQ(valve_summary(VerdictCode::valve_stiction,
                          evidence_of_band(model::EffectKind::valve_stiction, 5.0)),
            "");
}

/// Of these natural log odds, with the parts of two figures: the first speaks for either cause.
Causes between(double stiction, double play) {
  const std::size_t either = figure_place("step.hysteresis").value();
  const std::size_t cycle = figure_place("cycle.op_coherence").value();
  return {{VerdictCode::valve_stiction, stiction, 0.1, {{either, 500.0, 2.0}, {cycle, 0.9, 0.4}}},
          {VerdictCode::valve_deadband, play, 0.1, {{either, 500.0, 0.3}, {cycle, 0.9, -0.2}}}};
}

TEST(ValveWords, WhyItSticksAlthoughTheModelFoundDeadBand) {
  constexpr double kLine = 0.3;
  Evidence band = evidence_of_band(model::EffectKind::valve_deadband, 5.0);
  const auto why = [&](double stiction, double play) {
    return why_stiction(VerdictCode::valve_stiction, band, between(stiction, play), kLine);
  };
  EXPECT_EQ(why(2.0, -2.0),
            "What tells stiction (88 % probable) from dead band (12 %): all figures together.");
  EXPECT_EQ(why(0.0, -0.1),
            "This window can hardly tell stiction (50 % probable) from dead band (48 %).");
  band.cycle = model::CycleCause{};
  band.cycle->evidence.op_coherence = 0.9;
  EXPECT_EQ(why(2.0, -2.0),
            "What tells stiction (88 % probable) from dead band (12 %): op repeats its half cycle: "
            "90 %.");
  EXPECT_EQ(why(0.0, -0.1),
            "This window can hardly tell stiction (50 % probable) from dead band (48 %); for "
            "stiction speaks most: op repeats its half cycle: 90 %.");
  band.cycle->evidence.travel = 5.0;
  band.cycle->score = 0.5;
  Causes by_odds = between(2.0, -2.0);
  by_odds[1].parts.push_back({figure_place("band.odds").value(), 3.2, -2.0});
  EXPECT_EQ(
      why_stiction(VerdictCode::valve_stiction, band, by_odds, kLine),
      "What tells stiction (88 % probable) from dead band (12 %): odds that a valve with this "
      "band makes the cycle: 20 to 1.");
  EXPECT_EQ(why_stiction(VerdictCode::valve_deadband, band, between(2.0, -2.0), kLine), "");
  EXPECT_EQ(why_stiction(VerdictCode::valve_stiction,
                         evidence_of_band(model::EffectKind::valve_stiction, 5.0),
                         between(2.0, -2.0), kLine),
            "");
}

}  // namespace
}  // namespace loopscope::core::diagnosis
