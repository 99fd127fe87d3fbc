#include "tests/core/diagnosis/explanations.hpp"

#include <utility>

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
  evidence.valve_gain = {20.0, 0.1, std::nullopt};
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

}  // namespace loopscope::core::diagnosis
