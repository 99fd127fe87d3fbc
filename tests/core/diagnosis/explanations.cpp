#include "tests/core/diagnosis/explanations.hpp"

#include <gtest/gtest.h>
#include <utility>

#include "core/diagnosis/decide.hpp"

namespace loopscope::core::diagnosis {

model::Step clear_step(model::EffectKind effect, double before, double after) {
  model::Step step;
  step.effect = effect;
  step.holdout_error_before = before;
  step.holdout_error_after = after;
  step.evidence = 500.0;
  step.margin = 200.0;
  step.steadiness = 1.0;
  step.p = 1e-9;
  return step;
}

model::Explanation explanation_of(std::vector<model::Step> steps) {
  model::Explanation explanation;
  explanation.excited = true;
  explanation.noise_floor = 0.4;
  explanation.baseline.holdout_error = 1.0;
  explanation.baseline.process = {false, 1.0, 20.0, 0.0, 5.0};
  explanation.steps = std::move(steps);
  explanation.unexplained = {0.05, 0.5, 0.6, ""};
  explanation.questions = {{"op_direction", 0.4, ""}, {"periodic", 0.7, ""}};
  return explanation;
}

model::ClosedLoop ringing_loop() {
  return {2.0, 30.0, 0.95, 4.0, 0.08, 60.0, 500.0};
}

model::ClosedLoop calm_loop() {
  return {0.5, 30.0, 0.95, 1.5, 0.7, 60.0, 150.0};
}

model::ClosedLoop slow_loop() {
  return {0.02, 30.0, 0.95, 1.05, 1.0, 0.0, 2000.0, 9.0, 0.02 / 30.0};
}

Evidence quiet_evidence() {
  Evidence evidence;
  evidence.data_quality.usable = true;
  evidence.data_quality.saturated_fraction = 0.0;
  evidence.hos = hos::Result{};
  evidence.hos->segments = 127;
  evidence.hos->ngi = -0.0005;
  evidence.hos->nli = 0.03;
  evidence.hos->nonlinear_p = 0.6;
  evidence.performance.harris_low = 0.4;
  evidence.performance.harris_high = 0.8;
  evidence.performance.error_std = 0.8;
  evidence.valve_gain = {20.0, 0.1};
  return evidence;
}

Evidence evidence_with(std::optional<model::Explanation> model) {
  Evidence evidence = quiet_evidence();
  evidence.performance.harris_p = 1.0;
  evidence.performance.longest_delay_s = 10.0;
  evidence.model = std::move(model);
  return evidence;
}

void oscillate(Evidence& evidence, double period_s, double persistence) {
  evidence.oscillation = {true, period_s, 3.0, 1.0, persistence, kOscillationP};
}

void show_stiction_shapes(Evidence& evidence) {
  evidence.shape.shape_index = 0.8;
  evidence.shape.horch_dtau = 0.9;
  evidence.shape.horch_drho = 0.6;
}

void expect_verdict(const Evidence& evidence, VerdictCode code, std::optional<double> p) {
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(name(verdict.code), name(code));
  EXPECT_EQ(verdict.p, p) << name(code);
}

Case case_of(const Evidence& evidence) {
  return {evidence, judge_nonlinearity(evidence, {}), judge_valve(evidence)};
}

}  // namespace loopscope::core::diagnosis
