#include "core/diagnosis/model_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using testing::HasSubstr;

TEST(ModelWords, AStepNamesItsParametersAndErrors) {
  model::Step step = clear_step(model::EffectKind::valve_stiction, 0.91, 0.4);
  step.parameters = {{"S", "%", 4.2, 4.0, 4.4}, {"J", "%", 1.1, {}, {}}};
  step.law = "kano";
  EXPECT_EQ(step_text(step),
            "The model includes valve_stiction (S 4.2 %, J 1.1 %, law kano). One-step prediction "
            "error on held-out samples: 0.91 -> 0.4 (evidence 500, p 1e-09).");
}

/// Tails that far out say nothing: no "p 0", no "p 1e-308".
TEST(ModelWords, APThatIsNextToNothingIsABound) {
  model::Step step = clear_step(model::EffectKind::valve_stiction, 0.91, 0.4);
  for (const double p : {0.0, 1e-308, 9e-13}) {
    step.p = p;
    EXPECT_THAT(step_text(step), testing::EndsWith("(evidence 500, p < 1e-12)."));
  }
  model::Explanation explanation = explanation_of();
  explanation.unexplained.whiteness_p = 0.0;
  EXPECT_THAT(unexplained_text(explanation), HasSubstr("whiteness p < 1e-12)"));
}

TEST(ModelWords, WhatIsLeftIsToldWhereAnythingIs) {
  model::Explanation explanation = explanation_of();
  explanation.unexplained = {};
  explanation.unexplained.whiteness_p = 0.31;
  explanation.unexplained.fraction = 0.004;
  EXPECT_EQ(unexplained_text(explanation),
            "The model explains all of the explainable error (residual whiteness p 0.31).");
  explanation.unexplained.whiteness_p = 0.0075;
  EXPECT_EQ(unexplained_text(explanation),
            "The model explains nearly all of the explainable error, but its residual is not white "
            "(p 0.0075).");
  explanation.unexplained.whiteness_p = 0.31;
  explanation.unexplained.fraction = 0.12;
  EXPECT_EQ(
      unexplained_text(explanation),
      "The model leaves 12 % of the explainable error unexplained (residual whiteness p 0.31).");
}

TEST(ModelWords, AStatementStandsForTheParameters) {
  model::Step step = clear_step(model::EffectKind::load_step, 0.91, 0.4);
  step.statement = "The load steps by 3 at 1200 s.";
  EXPECT_THAT(step_text(step), testing::StartsWith("The load steps by 3 at 1200 s. One-step"));
}

TEST(ModelWords, WhatIsLeftNamesTheQuestionsThatFoundSomething) {
  model::Explanation explanation = explanation_of();
  explanation.unexplained.statement = "A slow wave is left.";
  explanation.questions[0].statement = "Errors follow the direction of op.";
  const std::string text = unexplained_text(explanation);
  EXPECT_THAT(text, HasSubstr("leaves 5 %"));
  EXPECT_THAT(text, HasSubstr("A slow wave is left. Errors follow the direction of op."));
}

TEST(ModelWords, AnUnstableLoopHasNoSensitivity) {
  model::ClosedLoop loop = ringing_loop();
  EXPECT_THAT(closed_loop_text(loop), HasSubstr("peak sensitivity 4, damping 0.08, period 60 s"));
  loop.peak_sensitivity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(closed_loop_text(loop), HasSubstr("unstable"));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
