#include "core/diagnosis/evidence/structure.hpp"

#include <gtest/gtest.h>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

TEST(Structure, TheSmallestOfTheTestsCountsTimesTheirNumber) {
  model::Explanation explanation = explanation_of();
  explanation.questions = {{"op_direction", 0.01, ""}, {"periodic", 0.7, ""}};
  EXPECT_DOUBLE_EQ(structure_p(explanation), 0.03);
  explanation.unexplained.whiteness_p = 1e-6;
  EXPECT_DOUBLE_EQ(structure_p(explanation), 3e-6);
}

TEST(Structure, ATestThatAStepAnswersIsLeftOut) {
  model::Explanation explanation =
      explanation_of({clear_step(model::EffectKind::external_oscillation)});
  explanation.questions = {{"periodic", 1e-9, ""}};
  EXPECT_GT(structure_p(explanation), 0.5);
}

TEST(Structure, CouplingAnOscillationOrWhatTheModelLeavesIsStructure) {
  EXPECT_FALSE(is_structured(quiet_evidence()));
  Evidence coupled = quiet_evidence();
  coupled.hos->nonlinear_p = 1e-4;
  EXPECT_TRUE(is_structured(coupled));
  Evidence oscillating = quiet_evidence();
  oscillate(oscillating, 60.0);
  EXPECT_TRUE(is_structured(oscillating));
  Evidence modelled = evidence_with(explanation_of());
  EXPECT_FALSE(is_structured(modelled));
  modelled.model->unexplained.whiteness_p = 1e-9;
  EXPECT_TRUE(is_structured(modelled));
  modelled.model->excited = false;
  EXPECT_FALSE(is_structured(modelled));
}

TEST(Structure, ANonlinearityShowsByCouplingAStepOrAResidualTest) {
  Evidence evidence = evidence_with(explanation_of());
  EXPECT_FALSE(shows_nonlinearity(evidence, 0.05));
  evidence.hos->nonlinear_p = 0.04;
  EXPECT_TRUE(shows_nonlinearity(evidence, 0.05));
  EXPECT_TRUE(shows_nonlinearity(
      evidence_with(explanation_of({clear_step(model::EffectKind::valve_deadband)})), 0.05));
  Evidence asked = evidence_with(explanation_of());
  asked.model->asked = {{model::EffectKind::process_nonlinearity, "response_level", 0.001}};
  EXPECT_TRUE(shows_nonlinearity(asked, 0.05));
  Evidence load = evidence_with(explanation_of({clear_step(model::EffectKind::load_step)}));
  EXPECT_FALSE(shows_nonlinearity(load, 0.05));
}

TEST(Structure, AnOscillationOfLittleWeightIsNone) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0);
  EXPECT_TRUE(oscillates(evidence));
  evidence.oscillation.amplitude = 0.4;  // 12 % of the error's variance
  EXPECT_FALSE(oscillates(evidence));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
