#include "core/diagnosis/verdict_p.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Code = VerdictCode;

constexpr double kCouplingP = 1e-4, kHarrisP = 1e-8;

/// Every test computed, coupling and an oscillation found.
Evidence tested_evidence() {
  Evidence evidence = quiet_evidence();
  evidence.hos->nonlinear_p = kCouplingP;
  evidence.performance.harris_p = kHarrisP;
  oscillate(evidence, 60.0);
  return evidence;
}

TEST(VerdictP, EachVerdictRestsOnTheTestOfItsCause) {
  const Evidence evidence = tested_evidence();
  EXPECT_EQ(p_of_verdict(Code::nonlinear_unexplained, evidence), kCouplingP);
  EXPECT_EQ(p_of_verdict(Code::process_nonlinearity, evidence), kCouplingP);
  EXPECT_EQ(p_of_verdict(Code::external_disturbance, evidence), kOscillationP);
  EXPECT_EQ(p_of_verdict(Code::tight_tuning, evidence), kOscillationP);
  EXPECT_EQ(p_of_verdict(Code::sluggish_tuning, evidence), kHarrisP);
  EXPECT_EQ(p_of_verdict(Code::valve_stiction, evidence), kOscillationP) << "the clearer of two";
}

TEST(VerdictP, SlownessIsAsRareAsItsMemoryAmongHealthyLoops) {
  Evidence evidence = evidence_with(explanation_of());
  evidence.performance.harris_p = kHarrisP;
  evidence.performance.error_memory_s = 400.0;
  evidence.model->closed_loop = slow_loop();  // integral time and longest delay make 40 s
  EXPECT_NEAR(*p_of_verdict(Code::sluggish_tuning, evidence), 0.27 * std::pow(10.0, -3.3), 1e-9);
  evidence.performance.harris_p = 0.5;
  EXPECT_EQ(p_of_verdict(Code::sluggish_tuning, evidence), 0.5);
}

TEST(VerdictP, AnOscillationOfNoWeightLendsNone) {
  Evidence evidence = tested_evidence();
  evidence.oscillation.amplitude = 0.1;
  EXPECT_EQ(p_of_verdict(Code::valve_stiction, evidence), kCouplingP);
  EXPECT_EQ(p_of_verdict(Code::tight_tuning, evidence), 1.0);
}

TEST(VerdictP, AStepOfTheModelIsAsRareAsItsEvidence) {
  model::Step step = clear_step(model::EffectKind::valve_deadband);
  step.evidence = 100.0;
  Evidence evidence = evidence_with(explanation_of({step}));
  EXPECT_EQ(p_of_verdict(Code::valve_deadband, evidence), measured_p(step));
  EXPECT_EQ(p_of_verdict(Code::valve_stiction, evidence), measured_p(step)) << "one fit";
  EXPECT_EQ(p_of_verdict(Code::process_change, evidence), 0.6) << "that of coupling";
  evidence.model->excited = false;
  EXPECT_EQ(p_of_verdict(Code::valve_deadband, evidence), 0.6);
}

TEST(VerdictP, MeasuredPFallsWithTheEvidenceAndNeverBelowTheStepsOwn) {
  model::Step step = clear_step(model::EffectKind::load_step);
  step.p = 1e-5;
  step.evidence = 50.0;
  EXPECT_NEAR(measured_p(step), 0.02 * std::exp(-2.0), 1e-12);
  step.evidence = 5000.0;
  EXPECT_EQ(measured_p(step), 1e-5);
  step.evidence = std::nan("");
  EXPECT_EQ(measured_p(step), 1.0);
}

TEST(VerdictP, FactsAndHealthHaveNone) {
  Evidence evidence = tested_evidence();
  EXPECT_EQ(p_of_verdict(Code::healthy, evidence), std::nullopt);
  EXPECT_EQ(p_of_verdict(Code::insufficient_data, evidence), std::nullopt);
  EXPECT_EQ(p_of_verdict(Code::not_controlling, evidence), std::nullopt);
  evidence.op_range_set = true;
  evidence.shape.mv_op_width = 0.4;
  EXPECT_EQ(p_of_verdict(Code::valve_stiction, evidence), kOscillationP) << "it follows";
  evidence.shape.mv_op_width = 3.0;
  EXPECT_EQ(p_of_verdict(Code::valve_stiction, evidence), std::nullopt);
  evidence.op_range_set = false;
  EXPECT_EQ(p_of_verdict(Code::valve_stiction, evidence), kOscillationP) << "% of what?";
  EXPECT_EQ(p_of_verdict(Code::sensor_fault, evidence), kCouplingP) << "inferred";
  evidence.data_quality.flags = {"pv_held"};
  EXPECT_EQ(p_of_verdict(Code::sensor_fault, evidence), std::nullopt) << "the data themselves";
  EXPECT_EQ(p_of_verdict(Code::valve_saturation, evidence), kCouplingP);
  evidence.data_quality.saturated_fraction = 0.3;
  EXPECT_EQ(p_of_verdict(Code::valve_saturation, evidence), std::nullopt);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
