#include "daemon/output/model_text.hpp"

#include <gtest/gtest.h>

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
  EXPECT_EQ(model_text(explanation),
            "  model         First order, gain 2, 20 s, delay 5 s; error on unseen samples 1 "
            "(one_step, floor 0.4)\n"
            "    + step 1    valve_stiction: The valve sticks, S 4.2 %. Error on unseen samples "
            "1 -> 0.5 (evidence 300, p 1e-09).\n"
            "    left        Of what could be explained the model leaves 10 % (whiteness p 0.3).\n"
            "    closed loop Closed loop implied by the records: peak sensitivity 1.5, damping "
            "0.7, period 60 s, settles in 2.5 min.\n");
}

TEST(ModelText, WithoutExcitationItClaimsNothing) {
  core::model::Explanation explanation = story();
  explanation.excited = false;
  explanation.excitation = "op stands still.";
  EXPECT_EQ(model_text(explanation), "  model         claims nothing: op stands still.\n");
}

}  // namespace
}  // namespace loopscope::daemon
