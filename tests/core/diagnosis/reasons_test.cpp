#include "core/diagnosis/reasons.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/diagnosis/evidence/figure.hpp"
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

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Part part(std::string_view figure, std::optional<double> value, double weight) {
  return {figure_place(figure).value(), value, weight};
}

TEST(Reasons, PartsForAndAgainstInWordsWithTheirNumbers) {
  const CauseReport report =
      report_of({VerdictCode::valve_stiction,
                 0.0,
                 0.2,
                 {part("cycle.op_coherence", 0.93, 1.0), part("oscillation.p", 0.0, -0.7),
                  part("position.width", std::nullopt, -0.2),
                  Part{std::nullopt, 0.12, 0.15, VerdictCode::tight_tuning},
                  part("shape.index", 0.5, 0.01)}});
  EXPECT_EQ(report.probability, 0.5);
  EXPECT_THAT(
      report.in_favour,
      ElementsAre("op repeats its half cycle: 93 % (odds times 2.72)",
                  "other causes together by their own figures: 12 %, most likely tight_tuning "
                  "(odds times 1.16)"));
  EXPECT_THAT(report.against,
              ElementsAre("test whether an oscillation is present: p = 1 (odds divided by 2.01)",
                          "figures that this window does not give (odds divided by 1.22)"));
}

NonlinearityFinding finding() {
  NonlinearityFinding nonlinearity;
  nonlinearity.reason = "No quadratic or cubic phase coupling found.";
  return nonlinearity;
}

TEST(Reasons, FindingsNameWhatTheModelTookIn) {
  const auto reasons = findings(
      evidence_with(explanation_of({clear_step(model::EffectKind::valve_stiction)})), finding());
  EXPECT_THAT(reasons,
              Contains(HasSubstr(
                  "valve_stiction. One-step prediction error on held-out samples: 1 -> 0.5")));
  EXPECT_THAT(reasons, Contains("No quadratic or cubic phase coupling found."));
  EXPECT_THAT(reasons, Not(Contains(HasSubstr("Oscillation of period"))));
}

TEST(Reasons, AModelThatIsNotExcitedIsBelievedOfWhatComesFromOutside) {
  Evidence evidence =
      evidence_with(explanation_of({clear_step(model::EffectKind::valve_deadband),
                                    clear_step(model::EffectKind::external_oscillation)}));
  evidence.model->excited = false;
  evidence.model->excitation = "Not excited: op stands still.";
  const auto reasons = findings(evidence, finding());
  EXPECT_THAT(reasons,
              Contains(HasSubstr("valve_deadband, but the controller output moves too little")));
  EXPECT_THAT(reasons, Contains(HasSubstr("external_oscillation. One-step")));
  EXPECT_THAT(reasons, Contains(HasSubstr("op stands still")));
}

TEST(Reasons, DataThatAreOddAreNamed) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.flags = {"pv_held", "op_missing"};
  evidence.data_quality.compression_factor = 12.0;
  evidence.data_quality.saturated_fraction = 0.3;
  const auto reasons = findings(evidence, finding());
  EXPECT_THAT(reasons, Contains(HasSubstr("renewed only every 12 samples")));
  EXPECT_THAT(reasons, Contains(HasSubstr("op does not move or is not recorded")));
  EXPECT_THAT(reasons, Contains(HasSubstr("at a limit of its range in 30 %")));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
