#include "core/diagnosis/reasons.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/diagnosis/evidence/figure.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using testing::HasSubstr;

TEST(Reasons, AStepNamesItsParametersAndErrors) {
  model::Step step = clear_step(model::EffectKind::valve_stiction, 0.91, 0.4);
  step.parameters = {{"S", "%", 4.2, 4.0, 4.4}, {"J", "%", 1.1, {}, {}}};
  step.law = "kano";
  EXPECT_EQ(step_text(step),
            "The model includes valve stiction (S 4.2 %, J 1.1 %, law kano). One-step prediction "
            "error on held-out samples: 0.91 -> 0.4 (evidence 500, p 1e-09).");
}

/// Tails that far out say nothing: no "p 0", no "p 1e-308".
TEST(Reasons, APThatIsNextToNothingIsABound) {
  model::Step step = clear_step(model::EffectKind::valve_stiction, 0.91, 0.4);
  for (const double p : {0.0, 1e-308, 9e-13}) {
    step.p = p;
    EXPECT_THAT(step_text(step), testing::EndsWith("(evidence 500, p < 1e-12)."));
  }
  model::Explanation explanation = explanation_of();
  explanation.unexplained.whiteness_p = 0.0;
  EXPECT_THAT(unexplained_text(explanation), HasSubstr("whiteness p < 1e-12)"));
}

TEST(Reasons, AStatementStandsForTheParameters) {
  model::Step step = clear_step(model::EffectKind::load_step, 0.91, 0.4);
  step.statement = "The load steps by 3 at 1200 s.";
  EXPECT_THAT(step_text(step), testing::StartsWith("The load steps by 3 at 1200 s. One-step"));
}

TEST(Reasons, WhatIsLeftNamesTheQuestionsThatFoundSomething) {
  model::Explanation explanation = explanation_of();
  explanation.unexplained.statement = "A slow wave is left.";
  explanation.questions[0].statement = "Errors follow the direction of op.";
  const std::string text =
      "The model leaves 5 % of the explainable error unexplained (residual whiteness p 0.5). A "
      "slow wave is left. Errors follow the direction of op.";
  EXPECT_EQ(unexplained_text(explanation), text);
  explanation.questions[1].statement = "A slow wave is left.";
  EXPECT_EQ(unexplained_text(explanation), text) << "nothing twice";
}

TEST(Reasons, AnUnstableLoopHasNoSensitivity) {
  const std::string start = "Closed loop by the fitted model and the recorded controller: ";
  model::ClosedLoop loop = ringing_loop();
  EXPECT_EQ(closed_loop_text(loop),
            start + "peak sensitivity 4, damping 0.08, period 60 s, settles in 8.33 min.");
  EXPECT_EQ(closed_loop_text(slow_loop()),
            start + "peak sensitivity 1.05, damping 1, no oscillation, settles in 33.3 min.");
  loop.peak_sensitivity = loop.settling_s = std::numeric_limits<double>::infinity();
  EXPECT_EQ(closed_loop_text(loop), start + "unstable, period 60 s.");
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
                  "other causes together by their own figures: 12 %, most likely tight tuning "
                  "(odds times 1.16)"));
  EXPECT_THAT(report.against,
              ElementsAre("test whether an oscillation is present: p = 1 (odds divided by 2.01)",
                          "some figures cannot be measured in this window (odds divided by 1.22)"));
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
                  "valve stiction. One-step prediction error on held-out samples: 1 -> 0.5")));
  EXPECT_THAT(reasons, Contains("No quadratic or cubic phase coupling found."));
  EXPECT_THAT(reasons, Not(Contains(HasSubstr("Oscillation of period"))));
}

TEST(Reasons, AModelThatIsNotExcitedIsBelievedOfWhatComesFromOutside) {
  Evidence evidence =
      evidence_with(explanation_of({clear_step(model::EffectKind::valve_deadband),
                                    clear_step(model::EffectKind::external_oscillation)}));
  evidence.model->excited = false;
  evidence.model->excitation = "Not excited: op does not move.";
  EXPECT_THAT(
      findings(evidence, finding()),
      ElementsAre("The model fitted valve deadband, but the controller output moves too little to "
                  "confirm it: rejected.",
                  "The model includes external oscillation. One-step prediction error on held-out "
                  "samples: 1 -> 0.5 (evidence 500, p 1e-09).",
                  "The process from op to pv could not be identified from these data. Not excited: "
                  "op does not move.",
                  finding().reason));
}

TEST(Reasons, DataThatAreOddAreNamed) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.flags = {"pv_held", "pv_quantised", "op_missing"};
  evidence.data_quality.compression_factor = 12.0;
  evidence.data_quality.quantisation_factor = 0.5;
  evidence.data_quality.saturated_fraction = 0.3;
  evidence.op_range_doubt = "op never leaves 0 to 1 of 0 to 100";
  EXPECT_THAT(
      findings(evidence, finding()),
      ElementsAre("op does not move or is not recorded: controller and valve cannot be judged.",
                  "pv moves in steps of 0.5 of its standard deviation.",
                  "pv is renewed only every 12 samples on average.",
                  "The controller output is at a limit of its range in 30 % of the samples.",
                  "The range of op in the catalogue cannot be right: op never leaves 0 to 1 of 0 "
                  "to 100.",
                  finding().reason));
}

TEST(Reasons, ALinearLoopWithAPositionerAndAnOscillationIsToldInFull) {
  model::Explanation model = explanation_of();
  model.process_doubt = "The process is doubtful.";
  model.closed_loop = calm_loop();
  Evidence evidence = evidence_with(model);
  oscillate(evidence, 90.0);
  evidence.shape.mv_op_width = 3.0;
  evidence.shape.mv_slip_jump = 2.0;
  evidence.shape.mv_stuck_fraction = 0.9;
  EXPECT_THAT(
      findings(evidence, finding()),
      ElementsAre("A linear loop model is sufficient. The model leaves 5 % of the explainable "
                  "error unexplained (residual whiteness p 0.5).",
                  "The process is doubtful.",
                  "Closed loop by the fitted model and the recorded controller: peak sensitivity "
                  "1.5, damping 0.7, period 60 s, settles in 2.5 min.",
                  "The mv-op plot is 3 % wide, mv jumps by 2 % when it leaves rest; mv stands "
                  "still in 90 % of the samples in which op moves.",
                  finding().reason, "Oscillation of period 90 s, regularity 3, persistence 0.95."));
}

TEST(Reasons, PartsStandBeforeWhatWasMeasured) {
  CauseReport cause;
  cause.in_favour = {"op repeats its half cycle: 93 % (odds times 2.72)"};
  cause.against = {"some figures cannot be measured in this window (odds divided by 1.22)"};
  EXPECT_THAT(
      reasons_for(cause, quiet_evidence(), finding()),
      ElementsAre("For: op repeats its half cycle: 93 % (odds times 2.72).",
                  "Against: some figures cannot be measured in this window (odds divided by 1.22).",
                  finding().reason));
}

/// What is to be done where a valve that is to be repaired stands beside the verdict, or does not.
TEST(Action, TuningWaitsWhereAValveIsAsProbableAsTheLine) {
  const auto action = [](VerdictCode code, const Causes& causes) {
    return action_for(code, quiet_evidence(), causes, 0.3);
  };
  const Causes valve{{VerdictCode::valve_deadband, 0.0, 0.1, {}}};
  EXPECT_EQ(action(VerdictCode::tight_tuning, {}),
            "Lower the controller gain or slow the integral action; check that no valve fault "
            "hides behind it.");
  EXPECT_EQ(action(VerdictCode::tight_tuning, valve),
            "Check linkage and positioner for backlash; measure the travel in both directions. Do "
            "not retune before that is repaired.");
  EXPECT_EQ(action(VerdictCode::valve_saturation, valve),
            "Check whether the valve is too small, the bypass open or the setpoint out of reach; "
            "tune only after that.");
  EXPECT_EQ(action(VerdictCode::external_disturbance, valve),
            "Find its source (feeds, utilities, another loop) before changing this loop.");
}

TEST(Action, OfANonlinearityItSaysWhatToRecord) {
  Evidence evidence = quiet_evidence();
  const auto action = [&] {
    return action_for(VerdictCode::nonlinear_unexplained, evidence, {}, 0.3);
  };
  EXPECT_EQ(action(), "Record the valve position (mv) or do a stroke test, then analyse again.");
  evidence.shape.mv_op_width = 3.0;
  EXPECT_EQ(action(), "Do a stroke test; compare pv with the valve position at several levels.");
  evidence.data_quality.flags = {"op_missing"};
  EXPECT_EQ(action(), "Record the controller output (op), then analyse again.");
}

}  // namespace
}  // namespace loopscope::core::diagnosis
