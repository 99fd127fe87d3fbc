#include <gtest/gtest.h>

#include "core/diagnosis/decide.hpp"
#include "tests/core/diagnosis/explanations.hpp"

/// Which p-value each verdict of the flow rests on.
namespace loopscope::core::diagnosis {
namespace {

constexpr double kCouplingP = 1e-4, kHarrisP = 1e-8;

/// Every test computed, no coupling, nothing found.
Evidence tested_evidence() {
  Evidence evidence = quiet_evidence();
  evidence.hos->nonlinear_p = 0.8;
  evidence.performance.harris_p = 1.0;
  evidence.oscillation.p = 1.0;
  return evidence;
}

Evidence coupled_evidence() {
  Evidence evidence = tested_evidence();
  evidence.hos->ngi = 0.02;
  evidence.hos->nli = 0.3;
  evidence.hos->nonlinear_p = kCouplingP;
  evidence.hos->peaks = {{0.1, 0.1, 0.8, {}}};
  return evidence;
}

TEST(VerdictP, CouplingRestsOnItsTest) {
  expect_verdict(coupled_evidence(), VerdictCode::nonlinear_unexplained, kCouplingP);
  Evidence evidence = coupled_evidence();
  evidence.data_quality.flags = {"op_constant"};
  expect_verdict(evidence, VerdictCode::nonlinear_unexplained, kCouplingP);
}

TEST(VerdictP, WhatEitherBranchWouldSayRestsOnTheStrongerTest) {
  Evidence evidence = coupled_evidence();
  oscillate(evidence, 60.0, 0.9);
  show_stiction_shapes(evidence);
  expect_verdict(evidence, VerdictCode::valve_stiction, kOscillationP);
  evidence.oscillation.p = 0.01;
  expect_verdict(evidence, VerdictCode::valve_stiction, kCouplingP);
  evidence.valve_gain = {0.6, 0.2};
  expect_verdict(evidence, VerdictCode::valve_oversized, kCouplingP);
}

TEST(VerdictP, AnOscillationOfNoWeightLendsNone) {
  Evidence evidence = coupled_evidence();
  oscillate(evidence, 60.0, 0.9);
  show_stiction_shapes(evidence);
  evidence.oscillation.amplitude = 0.1;
  expect_verdict(evidence, VerdictCode::valve_stiction, kCouplingP);
}

TEST(VerdictP, OscillationsRestOnTheirs) {
  Evidence evidence = tested_evidence();
  oscillate(evidence, 60.0, 0.2);
  expect_verdict(evidence, VerdictCode::tight_tuning, kOscillationP);
  oscillate(evidence, 60.0, 0.95);
  expect_verdict(evidence, VerdictCode::external_disturbance, kOscillationP);
  evidence.data_quality.flags = {"op_constant"};
  expect_verdict(evidence, VerdictCode::external_disturbance, kOscillationP);
  evidence.data_quality.flags = {"op_missing"};
  expect_verdict(evidence, VerdictCode::unexplained, kOscillationP);
  evidence.data_quality.flags = {};
  show_stiction_shapes(evidence);
  expect_verdict(evidence, VerdictCode::valve_stiction, kOscillationP);
  evidence.valve_gain = {0.6, 0.2};
  expect_verdict(evidence, VerdictCode::valve_oversized, kOscillationP);
}

TEST(VerdictP, SlownessRestsOnTheHarrisIndex) {
  Evidence evidence = tested_evidence();
  evidence.performance.harris_low = 0.02;
  evidence.performance.harris_high = 0.1;
  evidence.performance.harris_p = kHarrisP;
  expect_verdict(evidence, VerdictCode::sluggish_tuning, kHarrisP);
}

TEST(VerdictP, FactsAndHealthHaveNone) {
  expect_verdict(tested_evidence(), VerdictCode::healthy, std::nullopt);
  Evidence evidence = coupled_evidence();
  oscillate(evidence, 60.0, 0.9);
  evidence.shape.mv_op_width = 3.0;
  evidence.shape.mv_slip_jump = 2.0;
  expect_verdict(evidence, VerdictCode::valve_stiction, std::nullopt);
  evidence.data_quality.flags = {"sp_not_followed"};
  expect_verdict(evidence, VerdictCode::unexplained, std::nullopt);
  evidence.data_quality.saturated_fraction = 0.3;
  expect_verdict(evidence, VerdictCode::valve_saturation, std::nullopt);
  evidence.data_quality.flags = {"pv_frozen"};
  expect_verdict(evidence, VerdictCode::sensor_fault, std::nullopt);
  Evidence coarse = tested_evidence();
  coarse.data_quality.flags = {"pv_quantised"};
  expect_verdict(coarse, VerdictCode::sensor_fault, std::nullopt);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
