#include "core/diagnosis/decide.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Evidence nonlinear_evidence() {
  Evidence evidence = quiet_evidence();
  evidence.hos->ngi = 0.02;
  evidence.hos->nli = 0.3;
  evidence.hos->nonlinear_p = 1e-6;
  evidence.hos->coupling = hos::Coupling::quadratic;
  evidence.hos->peaks = {{0.1, 0.1, 0.8, {}}};
  return evidence;
}

VerdictCode code_of(const Evidence& evidence) {
  return decide(evidence, {}).code;
}

TEST(Decide, QuietLoopIsHealthy) {
  EXPECT_EQ(code_of(quiet_evidence()), VerdictCode::healthy);
}

TEST(Decide, UnusableDataAreNotJudged) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.usable = false;
  evidence.data_quality.reason = "pv is constant";
  evidence.hos.reset();
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, VerdictCode::insufficient_data);
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("pv is constant")));
}

TEST(Decide, AFrozenMeasurementComesBeforeEverythingElse) {
  Evidence evidence = nonlinear_evidence();
  evidence.data_quality.flags = {"pv_frozen"};
  EXPECT_EQ(code_of(evidence), VerdictCode::sensor_fault);
}

TEST(Decide, OutputAtItsLimitIsSaturation) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.saturated_fraction = 0.3;
  EXPECT_EQ(code_of(evidence), VerdictCode::valve_saturation);
}

TEST(Decide, SlowLoopIsSluggish) {
  Evidence evidence = quiet_evidence();
  evidence.performance.harris_low = 0.02;
  evidence.performance.harris_high = 0.1;
  EXPECT_EQ(code_of(evidence), VerdictCode::sluggish_tuning);
}

TEST(Decide, DecayingOscillationWithoutCouplingIsTuning) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.2);
  EXPECT_EQ(code_of(evidence), VerdictCode::tight_tuning);
}

TEST(Decide, AnOscillationOfNoWeightIsNoFault) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.3);
  evidence.oscillation.amplitude = 0.4;  // 12 % of the error's variance
  EXPECT_EQ(code_of(evidence), VerdictCode::healthy);
}

TEST(Decide, SustainedSinusoidIsADisturbanceEvenWhenHorchIsOdd) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.95);
  evidence.shape.shape_index = 0.2;
  evidence.shape.horch_dtau = 0.9;  // seed 5.3: odd although nothing sticks
  evidence.shape.horch_drho = 0.6;
  EXPECT_EQ(code_of(evidence), VerdictCode::external_disturbance);
}

TEST(Decide, ASustainedOscillationOfNoClearShapeIsBelievedLess) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.95);
  evidence.shape.shape_index = 0.2;
  const double sinusoid = decide(evidence, {}).confidence;
  evidence.shape.shape_index = 0.5;
  EXPECT_EQ(code_of(evidence), VerdictCode::external_disturbance);
  EXPECT_LT(decide(evidence, {}).confidence, 0.7 * sinusoid);
}

TEST(Decide, SymmetricLimitCycleIsStictionBecauseOfItsShape) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.95);
  show_stiction_shapes(evidence);
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, VerdictCode::valve_stiction);
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("blind")));
  Evidence coupled = nonlinear_evidence();
  oscillate(coupled, 60.0, 0.95);
  show_stiction_shapes(coupled);
  EXPECT_GT(decide(coupled, {}).confidence, verdict.confidence);
}

TEST(Decide, NonlinearWithTriangularShapesIsStiction) {
  Evidence evidence = nonlinear_evidence();
  oscillate(evidence, 60.0, 0.9);
  show_stiction_shapes(evidence);
  EXPECT_EQ(code_of(evidence), VerdictCode::valve_stiction);
}

TEST(Decide, AChanceFindingDoesNotHideAnOscillation) {
  Evidence evidence = nonlinear_evidence();
  oscillate(evidence, 60.0, 0.5);
  evidence.oscillation.p = 1e-6;
  evidence.hos->nonlinear_p = 0.03;
  EXPECT_EQ(code_of(evidence), VerdictCode::tight_tuning);
  evidence.hos->nonlinear_p = 1e-4;
  EXPECT_EQ(code_of(evidence), VerdictCode::nonlinear_unexplained);
  evidence.hos->nonlinear_p = 0.03;
  evidence.oscillation.p = 0.04;
  EXPECT_EQ(code_of(evidence), VerdictCode::nonlinear_unexplained);
}

TEST(Decide, NonlinearWithoutAPatternStaysUnexplained) {
  EXPECT_EQ(code_of(nonlinear_evidence()), VerdictCode::nonlinear_unexplained);
}

TEST(Decide, MarginalCouplingHasLittleConfidence) {
  Evidence evidence = nonlinear_evidence();
  const double clear = decide(evidence, {}).confidence;
  evidence.hos->nonlinear_p = 0.03;
  const Verdict marginal = decide(evidence, {});
  EXPECT_EQ(marginal.code, VerdictCode::nonlinear_unexplained);
  EXPECT_LT(marginal.confidence, 0.3);  // below what is flagged by default
  EXPECT_GT(clear, 0.3);
}

TEST(Decide, TinyOutputMovesAndALargeAnswerMeanAnOversizedValve) {
  Evidence evidence = nonlinear_evidence();
  evidence.valve_gain = {0.6, 0.3};  // paper, section 6.2.1: op between 49.4 and 50 %
  EXPECT_EQ(code_of(evidence), VerdictCode::valve_oversized);
}

TEST(Decide, AConstantOutputAccusesNoValve) {
  Evidence evidence = nonlinear_evidence();
  oscillate(evidence, 60.0, 0.9);
  show_stiction_shapes(evidence);
  evidence.data_quality.flags = {"op_constant"};
  EXPECT_EQ(code_of(evidence), VerdictCode::nonlinear_unexplained);
}

TEST(Decide, RecordedPositionDecidesDirectly) {
  Evidence evidence = quiet_evidence();
  evidence.shape.mv_op_width = 3.0;
  evidence.shape.mv_slip_jump = 2.0;
  evidence.shape.mv_stuck_fraction = 0.9;
  EXPECT_EQ(code_of(evidence), VerdictCode::valve_stiction);
  EXPECT_GE(decide(evidence, {}).confidence, 0.9);
  evidence.shape.mv_slip_jump = 0.1;  // a wide dead band stands still as often
  EXPECT_EQ(code_of(evidence), VerdictCode::valve_deadband);
}

TEST(Decide, AValveThatFollowsLeavesTheProcess) {
  Evidence evidence = nonlinear_evidence();
  evidence.shape.mv_op_width = 0.1;
  evidence.shape.mv_stuck_fraction = 0.0;
  EXPECT_EQ(code_of(evidence), VerdictCode::process_nonlinearity);
}

TEST(Decide, CorrelationHasNoVoteOnIntegratingLoops) {
  Evidence evidence = nonlinear_evidence();
  oscillate(evidence, 60.0, 0.9);
  evidence.shape.shape_index = 0.5;
  evidence.shape.horch_dtau = 0.9;
  evidence.shape.horch_drho = 0.6;
  EXPECT_EQ(code_of(evidence), VerdictCode::valve_stiction);
  evidence.integrating = true;
  EXPECT_EQ(code_of(evidence), VerdictCode::nonlinear_unexplained);
}

TEST(Decide, WithoutAnOutputNothingIsClaimedOfControllerAndValve) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.5);
  evidence.valve_gain = {0.0, 0.2};
  evidence.data_quality.flags = {"op_constant"};
  EXPECT_EQ(code_of(evidence), VerdictCode::external_disturbance);
  evidence.data_quality.flags = {"op_missing"};
  EXPECT_EQ(code_of(evidence), VerdictCode::unexplained);
  evidence = quiet_evidence();
  evidence.performance.harris_low = evidence.performance.harris_high = 0.1;
  evidence.data_quality.flags = {"op_missing"};
  EXPECT_EQ(code_of(evidence), VerdictCode::healthy);
}

TEST(Decide, AControllerThatIsNotInCommandIsNotHealthy) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.flags = {"sp_not_followed"};
  EXPECT_EQ(code_of(evidence), VerdictCode::unexplained);
}

/// The p-value has allowed for skewed noise already; a peak only says where.
TEST(Decide, CouplingWithoutAPeakIsBelievedByItsPAndNamesNoBifrequency) {
  Evidence evidence = nonlinear_evidence();
  evidence.hos->peaks = {{0.1, 0.1, 0.8, 1e-5}};
  const Verdict with_peak = decide(evidence, {});
  EXPECT_THAT(with_peak.reasons, Contains(HasSubstr("bifrequency (0.1, 0.1)")));
  evidence.hos->peaks.clear();
  const Verdict without_peak = decide(evidence, {});
  EXPECT_EQ(without_peak.code, with_peak.code);
  EXPECT_EQ(without_peak.confidence, with_peak.confidence);
  EXPECT_THAT(without_peak.reasons, Not(Contains(HasSubstr("bifrequency"))));
}

TEST(Decide, CorrelationAloneAccusesNobody) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.65);
  evidence.shape.horch_dtau = 0.75;  // what a tightly tuned loop of nine samples a cycle shows
  evidence.shape.horch_drho = 0.41;
  EXPECT_EQ(code_of(evidence), VerdictCode::tight_tuning);
}

TEST(Decide, AnOversizedValveIsNamedWithoutCouplingToo) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0, 0.5);
  show_stiction_shapes(evidence);
  evidence.valve_gain = {0.4, 0.1};
  EXPECT_EQ(code_of(evidence), VerdictCode::valve_oversized);
}

TEST(Decide, SlowLevelControlIsNoFault) {
  Evidence evidence = quiet_evidence();
  evidence.performance.harris_low = 0.03;
  evidence.performance.harris_high = 0.2;
  EXPECT_EQ(code_of(evidence), VerdictCode::sluggish_tuning);
  evidence.integrating = true;
  EXPECT_EQ(code_of(evidence), VerdictCode::healthy);
}

TEST(Decide, ACoarseOrStaleMeasurementIsASensorFault) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.quantisation_factor = 1.2;
  evidence.data_quality.flags = {"pv_quantised"};
  EXPECT_EQ(code_of(evidence), VerdictCode::sensor_fault);
  evidence = nonlinear_evidence();
  evidence.data_quality.compression_factor = 12.0;
  evidence.data_quality.flags = {"pv_held"};
  EXPECT_EQ(code_of(evidence), VerdictCode::sensor_fault);
}

TEST(Decide, ShortRecordsWeighLess) {
  Evidence evidence = quiet_evidence();
  const double full = decide(evidence, {}).confidence;
  evidence.data_quality.flags = {"short"};
  EXPECT_LT(decide(evidence, {}).confidence, full);
}

TEST(Decide, NothingIsEverCalledLinear) {
  for (const Evidence& evidence : {quiet_evidence(), nonlinear_evidence()}) {
    const Verdict verdict = decide(evidence, {});
    for (const std::string& reason : verdict.reasons) {
      EXPECT_THAT(reason, testing::Not(HasSubstr(" linear")));
    }
  }
}

}  // namespace
}  // namespace loopscope::core::diagnosis
