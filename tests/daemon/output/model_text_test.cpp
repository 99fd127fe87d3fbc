#include "daemon/output/model_text.hpp"

#include <gmock/gmock.h>

namespace loopscope::daemon {
namespace {

core::model::Explanation story() {
  core::model::Explanation explanation;
  explanation.excited = true;
  explanation.noise_floor = 0.4;
  explanation.baseline.description = "First order, gain 2, 20 s, delay 5 s";
  explanation.baseline.holdout_error = 1.0;
  explanation.unexplained = {0.1, 0.3, {}, ""};
  core::model::Step step;
  step.statement = "The valve sticks, S 4.2 %.";
  step.holdout_error_before = 1.0;
  step.holdout_error_after = 0.5;
  step.evidence = 300.0;
  step.p = 1e-9;
  explanation.steps = {step};
  return explanation;
}

TEST(ModelText, TellsTheStoryLineByLine) {
  core::model::Explanation explanation = story();
  explanation.closed_loop = {0.5, 30.0, 0.9, 1.5, 0.7, 60.0, 150.0};
  EXPECT_EQ(
      model_text(explanation),
      "  model         First order, gain 2, 20 s, delay 5 s; error on held-out samples 1 "
      "(one_step, floor 0.4)\n"
      "    + step 1    valve_stiction: The valve sticks, S 4.2 %. One-step prediction error "
      "on held-out samples: "
      "1 -> 0.5 (evidence 300, p 1e-09).\n"
      "                  no residual test pointed to it; a first screening did\n"
      "                The effects take 50 % off the error of the linear model; how sure they "
      "are is what evidence and p say.\n"
      "    left        The model leaves 10 % of the explainable error unexplained (residual "
      "whiteness p 0.3). It describes the loop in part only: take its figures as rough.\n"
      "    closed loop Closed loop by the fitted model and the recorded controller: peak "
      "sensitivity 1.5, damping "
      "0.7, period 60 s, settles in 2.5 min.\n");
}

TEST(ModelText, AStepNamesTheTestsThatAskedForIt) {
  core::model::Explanation explanation = story();
  explanation.steps[0].asked_by = {
      {"op_direction", 0.0, 0.31, "Errors follow the direction of op."},
      {"op_level", 0.004, {}, ""}};
  const std::string text = model_text(explanation);
  EXPECT_THAT(text, testing::HasSubstr(
                        "(evidence 300, p 1e-09).\n"
                        "                  asked for by op_direction (p < 1e-12, afterwards 0.31): "
                        "Errors follow the direction of op.\n"
                        "                  asked for by op_level (p = 0.004)\n"
                        "                The effects take 50 % off"));
}

TEST(ModelText, WithoutExcitationItClaimsNothing) {
  core::model::Explanation explanation = story();
  explanation.excited = false;
  explanation.excitation = "Not excited: op does not move.";
  EXPECT_EQ(model_text(explanation),
            "  model         process not identified. Not excited: op does not move.\n");
}

}  // namespace
}  // namespace loopscope::daemon
