#include <gtest/gtest.h>

#include "core/diagnosis/decide.hpp"

/// Which p-value each verdict of the flow rests on.
namespace loopscope::core::diagnosis {
namespace {

constexpr double kCouplingP = 1e-4, kOscillationP = 1e-6, kHarrisP = 1e-8;

/// Every test computed, no coupling, nothing found.
Evidence quiet_evidence() {
  Evidence evidence;
  evidence.data_quality.usable = true;
  evidence.hos = hos::Result{};
  evidence.hos->segments = 127;
  evidence.hos->ngi = -0.0005;
  evidence.hos->nli = 0.03;
  evidence.hos->nonlinear_p = 0.8;
  evidence.performance.harris_low = 0.4;
  evidence.performance.harris_high = 0.8;
  evidence.performance.harris_p = 1.0;
  evidence.performance.error_std = 0.8;
  evidence.oscillation.p = 1.0;
  evidence.valve_gain = {20.0, 0.1};
  return evidence;
}

Evidence coupled_evidence() {
  Evidence evidence = quiet_evidence();
  evidence.hos->ngi = 0.02;
  evidence.hos->nli = 0.3;
  evidence.hos->nonlinear_p = kCouplingP;
  evidence.hos->peaks = {{0.1, 0.1, 0.8, {}}};
  return evidence;
}

void oscillate(Evidence& evidence, double persistence) {
  evidence.oscillation = {true, 60.0, 3.0, 1.0, persistence, kOscillationP};
}

void show_triangular_shapes(Evidence& evidence) {
  evidence.shape.shape_index = 0.8;
  evidence.shape.horch_dtau = 0.9;
  evidence.shape.horch_drho = 0.6;
}

void expect(const Evidence& evidence, VerdictCode code, std::optional<double> p) {
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(name(verdict.code), name(code));
  EXPECT_EQ(verdict.p, p) << name(code);
}

TEST(VerdictP, CouplingRestsOnItsTest) {
  expect(coupled_evidence(), VerdictCode::nonlinear_unexplained, kCouplingP);
  Evidence evidence = coupled_evidence();
  evidence.data_quality.flags = {"op_constant"};
  expect(evidence, VerdictCode::nonlinear_unexplained, kCouplingP);
}

TEST(VerdictP, WhatEitherBranchWouldSayRestsOnTheStrongerTest) {
  Evidence evidence = coupled_evidence();
  oscillate(evidence, 0.9);
  show_triangular_shapes(evidence);
  expect(evidence, VerdictCode::valve_stiction, kOscillationP);
  evidence.oscillation.p = 0.01;
  expect(evidence, VerdictCode::valve_stiction, kCouplingP);
  evidence.valve_gain = {0.6, 0.2};
  expect(evidence, VerdictCode::valve_oversized, kCouplingP);
}

TEST(VerdictP, AnOscillationOfNoWeightLendsNone) {
  Evidence evidence = coupled_evidence();
  oscillate(evidence, 0.9);
  show_triangular_shapes(evidence);
  evidence.oscillation.amplitude = 0.1;
  expect(evidence, VerdictCode::valve_stiction, kCouplingP);
}

TEST(VerdictP, OscillationsRestOnTheirs) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 0.2);
  expect(evidence, VerdictCode::tight_tuning, kOscillationP);
  oscillate(evidence, 0.95);
  expect(evidence, VerdictCode::external_disturbance, kOscillationP);
  evidence.data_quality.flags = {"op_constant"};
  expect(evidence, VerdictCode::external_disturbance, kOscillationP);
  evidence.data_quality.flags = {"op_missing"};
  expect(evidence, VerdictCode::unexplained, kOscillationP);
  evidence.data_quality.flags = {};
  show_triangular_shapes(evidence);
  expect(evidence, VerdictCode::valve_stiction, kOscillationP);
  evidence.valve_gain = {0.6, 0.2};
  expect(evidence, VerdictCode::valve_oversized, kOscillationP);
}

TEST(VerdictP, SlownessRestsOnTheHarrisIndex) {
  Evidence evidence = quiet_evidence();
  evidence.performance.harris_low = 0.02;
  evidence.performance.harris_high = 0.1;
  evidence.performance.harris_p = kHarrisP;
  expect(evidence, VerdictCode::sluggish_tuning, kHarrisP);
}

TEST(VerdictP, FactsAndHealthHaveNone) {
  expect(quiet_evidence(), VerdictCode::healthy, std::nullopt);
  Evidence evidence = coupled_evidence();
  oscillate(evidence, 0.9);
  evidence.shape.mv_op_width = 3.0;
  evidence.shape.mv_slip_jump = 2.0;
  expect(evidence, VerdictCode::valve_stiction, std::nullopt);
  evidence.data_quality.flags = {"sp_not_followed"};
  expect(evidence, VerdictCode::unexplained, std::nullopt);
  evidence.data_quality.saturated_fraction = 0.3;
  expect(evidence, VerdictCode::valve_saturation, std::nullopt);
  evidence.data_quality.flags = {"pv_frozen"};
  expect(evidence, VerdictCode::sensor_fault, std::nullopt);
  Evidence coarse = quiet_evidence();
  coarse.data_quality.flags = {"pv_quantised"};
  expect(coarse, VerdictCode::sensor_fault, std::nullopt);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
