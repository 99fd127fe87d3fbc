#include "core/diagnosis/contradiction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using enum model::EffectKind;
using testing::HasSubstr;
using testing::IsEmpty;

std::string doubt(model::EffectKind effect, const Evidence& evidence) {
  return contradiction_of(clear_step(effect), case_of(evidence));
}

TEST(Contradiction, WithoutARecordNothingIsRefuted) {
  const Evidence evidence = evidence_with(explanation_of());
  for (const model::EffectKind effect : model::all_effect_kinds()) {
    EXPECT_THAT(doubt(effect, evidence), IsEmpty()) << model::name(effect);
  }
}

TEST(Contradiction, AValveThatFollowsDoesNotStickAndHasNoPlay) {
  Evidence evidence = evidence_with(explanation_of());
  evidence.shape.mv_op_width = 0.1;
  EXPECT_THAT(doubt(valve_stiction, evidence), HasSubstr("follows"));
  EXPECT_THAT(doubt(valve_deadband, evidence), HasSubstr("follows"));
  EXPECT_THAT(doubt(valve_characteristic, evidence), IsEmpty());
}

TEST(Contradiction, AValveBesideTheCycleIsNotItsCause) {
  model::Step step = clear_step(valve_stiction);
  step.beside_the_cycle = true;
  const Evidence evidence = evidence_with(explanation_of({step}));
  EXPECT_THAT(contradiction_of(step, case_of(evidence)), HasSubstr("cycles"));
  EXPECT_THAT(believed(case_of(evidence)).explanation.steps, IsEmpty());
}

TEST(Contradiction, InALevelLoopPlayThatExplainsItsCycleToTheLastIsPlay) {
  model::Step play = clear_step(valve_deadband);
  play.cycles_as_if_stuck = true;
  const auto stuck = [](const Evidence& evidence) {
    return believed(case_of(evidence)).explanation.steps.at(0).cycles_as_if_stuck;
  };
  Evidence evidence = evidence_with(explanation_of({play}));
  EXPECT_TRUE(stuck(evidence)) << "play alone does not make a flow loop cycle";
  evidence.integrating = true;
  EXPECT_FALSE(stuck(evidence));
  EXPECT_THAT(believed(case_of(evidence)).doubts, testing::Contains(HasSubstr("by itself")));
  evidence.model->unexplained.whiteness_p = 1e-9;
  EXPECT_TRUE(stuck(evidence)) << "something is left";
  evidence.model->unexplained.whiteness_p = 0.5;
  evidence.model->steps[0].evidence = 299.0;
  EXPECT_TRUE(stuck(evidence)) << "too little for a slip to show";
}

TEST(Contradiction, ASensorFaultHasToShowInPv) {
  Evidence evidence = evidence_with(explanation_of());
  evidence.data_quality.compression_factor = 1.02;
  evidence.data_quality.quantisation_factor = 0.001;
  EXPECT_THAT(doubt(sensor_hold, evidence), HasSubstr("1.02"));
  EXPECT_THAT(doubt(sensor_quantisation, evidence), HasSubstr("0.001"));
  evidence.data_quality.compression_factor = 2.4;
  evidence.data_quality.quantisation_factor = 0.3;
  EXPECT_THAT(doubt(sensor_hold, evidence), IsEmpty());
  EXPECT_THAT(doubt(sensor_quantisation, evidence), IsEmpty());
}

TEST(Contradiction, RefutedStepsAreTakenOutAndNamed) {
  Evidence evidence =
      evidence_with(explanation_of({clear_step(sensor_hold), clear_step(load_step)}));
  evidence.data_quality.compression_factor = 1.0;
  const BelievedExplanation story = believed(case_of(evidence));
  ASSERT_EQ(story.explanation.steps.size(), 1U);
  EXPECT_EQ(story.explanation.steps[0].effect, load_step);
  EXPECT_THAT(story.doubts, testing::ElementsAre(HasSubstr("sensor_hold")));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
