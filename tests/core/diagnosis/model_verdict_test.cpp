#include "core/diagnosis/model_verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/effect_verdict.hpp"
#include "core/diagnosis/model_confidence.hpp"
#include "tests/core/diagnosis/explanations.hpp"

/// Handmade explanations through the whole flow.
namespace loopscope::core::diagnosis {
namespace {

using enum model::EffectKind;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Verdict judge(const Evidence& evidence) {
  return decide(evidence, {});
}

Verdict judge_steps(std::vector<model::Step> steps) {
  return judge(evidence_with(explanation_of(std::move(steps))));
}

TEST(ModelVerdict, EveryEffectThatExplainsMostGivesItsVerdict) {
  for (const model::EffectKind effect : model::all_effect_kinds()) {
    model::Step step = clear_step(effect);
    step.p = 1e-5;
    const Verdict verdict = judge_steps({step});
    EXPECT_EQ(verdict.code, verdict_of(effect)) << model::name(effect);
    EXPECT_GT(verdict.confidence, 0.9) << model::name(effect);
    EXPECT_EQ(verdict.p, 1e-5) << model::name(effect);
    EXPECT_THAT(verdict.reasons, Contains(HasSubstr("1 -> 0.5"))) << model::name(effect);
  }
}

TEST(ModelVerdict, OfTwoEffectsTheLargerLeadsAndBothAreReasons) {
  model::Step minor = clear_step(external_oscillation, 1.0, 0.8);
  minor.p = 1e-4;
  const Verdict verdict = judge_steps({minor, clear_step(valve_stiction, 0.8, 0.2)});
  EXPECT_EQ(verdict.code, VerdictCode::valve_stiction);
  EXPECT_EQ(verdict.p, measured_p(clear_step(valve_stiction)));
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("external_oscillation. Error on unseen samples "
                                                  "1 -> 0.8")));
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("0.8 -> 0.2")));
  EXPECT_THAT(verdict.action, HasSubstr("stem"));
}

TEST(ModelVerdict, LoadsThatComeWithTheAnswerToTheSetpointAreNoCause) {
  model::Step load = clear_step(load_step);
  load.setpoint_chance = 0.001;
  load.statement = "It begins when the loop answers its setpoint.";
  Evidence evidence = evidence_with(explanation_of({load}));
  EXPECT_EQ(judge(evidence).code, VerdictCode::unexplained);
  EXPECT_THAT(judge(evidence).reasons, Contains(HasSubstr("answers its setpoint")));
}

TEST(ModelVerdict, ThatItIsNonlinearIsAClaimOfTheStatistics) {
  model::Step load = clear_step(load_step);
  load.setpoint_chance = 0.001;
  Evidence evidence = evidence_with(explanation_of({load}));
  evidence.hos->nonlinear_p = 0.009;
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(verdict.code, VerdictCode::nonlinear_unexplained);
  EXPECT_EQ(verdict.p, 0.009);
  evidence.hos->nonlinear_p = 1e-9;
  EXPECT_GT(judge(evidence).confidence, verdict.confidence);
}

Evidence unexcited(std::vector<model::Step> steps) {
  Evidence evidence = evidence_with(explanation_of(std::move(steps)));
  evidence.model->excited = false;
  evidence.model->excitation = "Not excited: op stands still.";
  return evidence;
}

TEST(ModelVerdict, WithoutExcitationWhatCameFromOutsideIsKnownAllTheSame) {
  const Verdict verdict =
      judge(unexcited({clear_step(valve_deadband), clear_step(external_oscillation, 0.5, 0.2)}));
  EXPECT_EQ(verdict.code, VerdictCode::external_disturbance);
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("valve_deadband, but op moves too little")));
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("op stands still")));
}

TEST(ModelVerdict, WithoutExcitationNothingElseIsClaimed) {
  EXPECT_EQ(judge(unexcited({clear_step(valve_deadband)})).code, VerdictCode::healthy);
  EXPECT_EQ(judge(unexcited({clear_step(gain_change)})).code, VerdictCode::healthy);
  EXPECT_EQ(judge(unexcited({})).code, VerdictCode::healthy);
}

TEST(ModelVerdict, WithoutExcitationTheStatisticsKeepWhatTheyKnow) {
  Evidence evidence = unexcited({clear_step(load_step)});
  evidence.hos->nonlinear_p = 1e-9;
  EXPECT_EQ(judge(evidence).code, VerdictCode::nonlinear_unexplained);
}

TEST(ModelVerdict, AStructuredRestIsSaidAndHoldsTheConfidence) {
  model::Explanation explanation = explanation_of({clear_step(valve_stiction)});
  explanation.unexplained.whiteness_p = 1e-12;
  explanation.unexplained.statement = "A wave of 300 s is left.";
  const Verdict verdict = judge(evidence_with(explanation));
  EXPECT_EQ(verdict.code, VerdictCode::valve_stiction);
  EXPECT_LE(verdict.confidence, 0.6);
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("A wave of 300 s is left.")));
}

/// Seed 5.3: the cross-correlation of an outside sinusoid is odd, as if the valve stuck.
TEST(ModelVerdict, AnOutsideSinusoidOverrulesTheCrossCorrelation) {
  Evidence evidence = evidence_with(explanation_of({clear_step(external_oscillation)}));
  oscillate(evidence, 40.0);
  show_stiction_shapes(evidence);
  evidence.hos->nonlinear_p = 1e-6;
  ASSERT_EQ(case_of(evidence).valve.kind, ValvePattern::Kind::sticks);
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(verdict.code, VerdictCode::external_disturbance);
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("overrules")));
}

TEST(ModelVerdict, FactsComeFirstAndKeepTheEffectsAsReasons) {
  Evidence evidence = evidence_with(explanation_of({clear_step(external_oscillation)}));
  evidence.data_quality.saturated_fraction = 0.4;
  EXPECT_EQ(judge(evidence).code, VerdictCode::valve_saturation);
  EXPECT_THAT(judge(evidence).reasons, Contains(HasSubstr("external_oscillation")));
  evidence.data_quality.flags = {"pv_frozen"};
  EXPECT_EQ(judge(evidence).code, VerdictCode::sensor_fault);
  evidence.data_quality.saturated_fraction = 0.0;
  evidence.data_quality.flags = {"sp_not_followed"};
  EXPECT_EQ(judge(evidence).code, VerdictCode::unexplained);
  evidence.data_quality.flags = {};
  evidence.shape.mv_op_width = 3.0;
  evidence.shape.mv_slip_jump = 2.0;
  EXPECT_EQ(judge(evidence).code, VerdictCode::valve_stiction);
  EXPECT_EQ(judge(evidence).p, std::nullopt);
  evidence.data_quality.usable = false;
  EXPECT_EQ(judge(evidence).code, VerdictCode::insufficient_data);
}

TEST(ModelVerdict, AValveThatIsSeenToFollowIsNotAccused) {
  Evidence evidence = evidence_with(
      explanation_of({clear_step(valve_stiction, 1.0, 0.4), clear_step(load_step, 0.4, 0.35)}));
  evidence.shape.mv_op_width = 0.1;
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(verdict.code, VerdictCode::external_disturbance);
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("not believed")));
}

TEST(ModelVerdict, AHoldThatPvDoesNotShowIsNotBelieved) {
  Evidence evidence = evidence_with(explanation_of({clear_step(sensor_hold)}));
  evidence.data_quality.compression_factor = 1.0;
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(verdict.code, VerdictCode::healthy);
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("sensor_hold")));
}

/// The grid of pv shows it; the error need not fall.
TEST(ModelVerdict, ACoarseGridIsAFactWithoutADrop) {
  model::Step grid = clear_step(sensor_quantisation, 1.0, 1.0);
  grid.evidence = 0.0;
  Evidence evidence = evidence_with(explanation_of({grid}));
  evidence.data_quality.quantisation_factor = 0.8;
  evidence.data_quality.flags = {"pv_quantised"};
  const Verdict coarse = judge(evidence);
  EXPECT_EQ(coarse.code, VerdictCode::sensor_fault);
  EXPECT_GE(coarse.confidence, 0.5);
  EXPECT_EQ(coarse.p, std::nullopt);
  evidence.model->steps.push_back(clear_step(valve_stiction));
  EXPECT_EQ(judge(evidence).code, VerdictCode::valve_stiction);
}

TEST(ModelVerdict, TinyMovesOfAValveThatCyclesMeanItsSize) {
  for (const model::EffectKind effect : {valve_stiction, valve_deadband, process_nonlinearity}) {
    Evidence evidence = evidence_with(explanation_of({clear_step(effect)}));
    evidence.valve_gain = {0.6, 0.3};
    EXPECT_EQ(judge(evidence).code, VerdictCode::valve_oversized) << model::name(effect);
    EXPECT_EQ(judge(evidence).p, measured_p(clear_step(effect)));
  }
  Evidence evidence = evidence_with(explanation_of({clear_step(external_oscillation)}));
  evidence.valve_gain = {0.6, 0.3};
  EXPECT_EQ(judge(evidence).code, VerdictCode::external_disturbance);
}

TEST(ModelVerdict, TuningWaitsForValveAndSensor) {
  model::Explanation explanation = explanation_of({clear_step(valve_stiction)});
  explanation.closed_loop = ringing_loop();
  const Verdict sticks = judge(evidence_with(explanation));
  EXPECT_THAT(sticks.action, HasSubstr("Leave the tuning alone"));
  EXPECT_THAT(sticks.reasons, Contains(HasSubstr("No advice on tuning")));
  explanation.steps = {clear_step(external_oscillation)};
  const Verdict outside = judge(evidence_with(explanation));
  EXPECT_THAT(outside.action, Not(HasSubstr("Leave the tuning alone")));
  EXPECT_THAT(outside.reasons, Not(Contains(HasSubstr("No advice on tuning"))));
  explanation.steps.push_back(clear_step(valve_deadband, 0.5, 0.4));
  EXPECT_THAT(judge(evidence_with(explanation)).reasons, Contains(HasSubstr("No advice on tuning")))
      << "a lesser valve fault stands as well";
}

TEST(ModelVerdict, MissingSamplesAndShortRecordsCost) {
  Evidence evidence = evidence_with(explanation_of({clear_step(valve_stiction)}));
  const double full = judge(evidence).confidence;
  evidence.data_quality.missing_fraction = 0.2;
  EXPECT_NEAR(judge(evidence).confidence, 0.8 * full, 1e-9);
  evidence.data_quality.missing_fraction = 0.0;
  evidence.data_quality.flags = {"short"};
  EXPECT_NEAR(judge(evidence).confidence, 0.75 * full, 1e-9);
}

TEST(ModelVerdict, AModelThatIsNotExcitedClaimsNothing) {
  model::Explanation explanation = explanation_of({clear_step(valve_stiction)});
  explanation.excited = false;
  explanation.excitation = "op moves by 0.01 % only.";
  explanation.closed_loop = ringing_loop();
  for (const double p : {0.6, 1e-6}) {
    Evidence evidence = evidence_with(std::nullopt);
    evidence.hos->nonlinear_p = p;
    const Verdict before = judge(evidence);
    evidence.model = explanation;
    const Verdict after = judge(evidence);
    EXPECT_EQ(after.code, before.code);
    EXPECT_EQ(after.confidence, before.confidence);
    EXPECT_EQ(after.p, before.p);
    EXPECT_THAT(after.reasons, Contains(HasSubstr("op moves by 0.01 % only.")));
  }
}

TEST(ModelVerdict, ConfidenceIsThatOfTheExplanation) {
  const model::Explanation explanation = explanation_of(
      {clear_step(valve_stiction, 1.0, 0.5), clear_step(external_oscillation, 0.5, 0.4)});
  EXPECT_EQ(judge(evidence_with(explanation)).confidence, confidence_of(explanation));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
