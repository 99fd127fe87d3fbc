#include "core/diagnosis/stepless_verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/model_confidence.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A loop whose model needs no effect, with this implied closed loop.
Evidence plain(std::optional<model::ClosedLoop> closed_loop) {
  Evidence evidence = evidence_with(explanation_of());
  evidence.model->closed_loop = closed_loop;
  return evidence;
}

/// An error that remembers five times as long as an integral time of 30 s and a delay of 10 s.
void creep(Evidence& evidence) {
  evidence.performance.error_memory_s = 200.0;
  evidence.performance.harris_low = 0.05;
  evidence.performance.harris_high = 0.2;
  evidence.performance.harris_p = 1e-8;
}

TEST(SteplessVerdict, NothingLeftIsHealthyAndSurerThanWithoutAModel) {
  expect_verdict(plain(calm_loop()), VerdictCode::healthy, std::nullopt);
  EXPECT_GT(decide(plain(calm_loop()), {}).confidence,
            decide(evidence_with(std::nullopt), {}).confidence);
  expect_verdict(plain(std::nullopt), VerdictCode::healthy, std::nullopt);
}

TEST(SteplessVerdict, RingingAtTheLoopsOwnPeriodIsTuning) {
  Evidence evidence = plain(ringing_loop());
  oscillate(evidence, 58.0, 0.6);
  expect_verdict(evidence, VerdictCode::tight_tuning, 1e-6);
  EXPECT_THAT(decide(evidence, {}).reasons, Contains(HasSubstr("peak sensitivity 4")));
}

TEST(SteplessVerdict, ATightLoopThatDoesNotOscillateIsNotAccused) {
  expect_verdict(plain(ringing_loop()), VerdictCode::healthy, std::nullopt);
}

TEST(SteplessVerdict, AControllerThatIsHardlyKnownIsAccusedLess) {
  Evidence evidence = plain(ringing_loop());
  oscillate(evidence, 58.0, 0.6);
  const double known = decide(evidence, {}).confidence;
  evidence.model->closed_loop->controller_fit = 0.4;
  EXPECT_LT(decide(evidence, {}).confidence, 0.5 * known);
}

TEST(SteplessVerdict, AnotherPeriodComesFromOutside) {
  for (const model::ClosedLoop& loop : {ringing_loop(), calm_loop(), slow_loop()}) {
    Evidence evidence = plain(loop);
    oscillate(evidence, 130.0, 0.5);
    show_stiction_shapes(evidence);
    expect_verdict(evidence, VerdictCode::external_disturbance, 1e-6);
  }
}

TEST(SteplessVerdict, AtADampedResonanceTheLineDecides) {
  Evidence evidence = plain(calm_loop());
  oscillate(evidence, 60.0, 0.95);
  expect_verdict(evidence, VerdictCode::external_disturbance, 1e-6);
  oscillate(evidence, 60.0, 0.5);
  expect_verdict(evidence, VerdictCode::tight_tuning, 1e-6);
  EXPECT_LT(decide(evidence, {}).confidence, 0.3) << "below what is flagged";
}

TEST(SteplessVerdict, WithoutAControllerTheLineDecides) {
  Evidence evidence = plain(std::nullopt);
  oscillate(evidence, 60.0, 0.95);
  expect_verdict(evidence, VerdictCode::external_disturbance, 1e-6);
  oscillate(evidence, 60.0, 0.3);
  expect_verdict(evidence, VerdictCode::tight_tuning, 1e-6);
}

TEST(SteplessVerdict, AtRestAnErrorThatRemembersForLongIsSlowTuning) {
  Evidence evidence = plain(slow_loop());
  expect_verdict(evidence, VerdictCode::healthy, std::nullopt);
  creep(evidence);
  expect_verdict(evidence, VerdictCode::sluggish_tuning, 1e-8);
  evidence.integrating = true;
  expect_verdict(evidence, VerdictCode::healthy, std::nullopt);
  evidence.integrating = false;
  evidence.performance.error_memory_s = 119.0;
  expect_verdict(evidence, VerdictCode::healthy, std::nullopt);
  evidence.performance.harris_p.reset();
  evidence.performance.error_memory_s = 200.0;
  expect_verdict(evidence, VerdictCode::sluggish_tuning, 1.0);
}

TEST(SteplessVerdict, NextToPureIntegralActionADoubtfulMemoryIsNamedAndNotFlagged) {
  constexpr double kLeastOfAFlag = 0.3;  // config/, flags.min_confidence
  Evidence evidence = plain(slow_loop());
  creep(evidence);
  evidence.performance.error_memory_s = 30.0;
  evidence.model->closed_loop->integral_time_s = 2.0;
  expect_verdict(evidence, VerdictCode::sluggish_tuning, 1e-8);
  EXPECT_LT(decide(evidence, {}).confidence, kLeastOfAFlag);
  evidence.performance.error_memory_s = 18.0;
  expect_verdict(evidence, VerdictCode::healthy, std::nullopt);
  evidence.performance.error_memory_s = 30.0;
  evidence.performance.harris_low = evidence.performance.harris_high = 0.8;
  expect_verdict(evidence, VerdictCode::healthy, std::nullopt);
}

TEST(SteplessVerdict, WhereTheSetpointMovesProcessAndControllerAreCompared) {
  Evidence moved = plain(slow_loop());
  moved.data_quality.flags = {"sp_steps_masked"};
  EXPECT_EQ(decide(moved, {}).code, VerdictCode::healthy) << "its error forgets in time";
  moved.performance.error_memory_s = 90.0;
  EXPECT_EQ(decide(moved, {}).code, VerdictCode::sluggish_tuning);
  moved.model->closed_loop->integral_per_s = 0.2;
  EXPECT_EQ(decide(moved, {}).code, VerdictCode::healthy) << "as fast as the process itself";
}

TEST(SteplessVerdict, SlowLoopsThatShouldRingAreDoubted) {
  Evidence evidence = plain(slow_loop());
  creep(evidence);
  evidence.model->baseline.process.integrating = true;
  const double clear = decide(evidence, {}).confidence;
  evidence.model->closed_loop->peak_sensitivity = 4.0;
  EXPECT_EQ(decide(evidence, {}).code, VerdictCode::sluggish_tuning);
  EXPECT_NEAR(decide(evidence, {}).confidence, 0.5 * clear, 1e-9);
}

TEST(SteplessVerdict, AtRestTheErrorSaysHowSureSlownessIs) {
  Evidence evidence = plain(slow_loop());
  creep(evidence);
  evidence.performance.error_memory_s = 240.0;
  const double clear = decide(evidence, {}).confidence;
  evidence.performance.error_memory_s = 121.0;
  EXPECT_EQ(decide(evidence, {}).code, VerdictCode::sluggish_tuning);
  EXPECT_NEAR(decide(evidence, {}).confidence, 0.5 * clear, 0.01);
}

TEST(SteplessVerdict, ALineThatLeavesThePolesUndampedComesFromOutside) {
  Evidence evidence = plain(ringing_loop());
  evidence.model->closed_loop->damping = 0.001;
  oscillate(evidence, 60.0, 0.95);
  expect_verdict(evidence, VerdictCode::external_disturbance, 1e-6);
  oscillate(evidence, 60.0, 0.6);
  expect_verdict(evidence, VerdictCode::tight_tuning, 1e-6);
}

TEST(SteplessVerdict, CouplingWithoutAnEffectStaysUnexplained) {
  Evidence evidence = plain(calm_loop());
  evidence.hos->nonlinear_p = 1e-6;
  expect_verdict(evidence, VerdictCode::nonlinear_unexplained, 1e-6);
  oscillate(evidence, 130.0);
  expect_verdict(evidence, VerdictCode::nonlinear_unexplained, 1e-6);
  oscillate(evidence, 60.0, 0.6);
  evidence.model->closed_loop = ringing_loop();
  expect_verdict(evidence, VerdictCode::tight_tuning, 1e-6);
}

TEST(SteplessVerdict, AStructuredRestIsUnexplained) {
  Evidence evidence = plain(calm_loop());
  evidence.model->unexplained.whiteness_p = 1e-7;
  expect_verdict(evidence, VerdictCode::unexplained, structure_p(*evidence.model));
  evidence.model->unexplained.whiteness_p = 0.01;
  expect_verdict(evidence, VerdictCode::healthy, std::nullopt);
}

TEST(SteplessVerdict, StructureHoldsTuningToo) {
  Evidence evidence = plain(ringing_loop());
  oscillate(evidence, 58.0, 0.6);
  evidence.model->questions[0].p = 1e-9;
  EXPECT_LE(decide(evidence, {}).confidence, 0.6);
}

TEST(SteplessVerdict, TuningAdviceWaitsForTheSensor) {
  Evidence evidence = plain(ringing_loop());
  oscillate(evidence, 58.0, 0.6);
  evidence.data_quality.quantisation_factor = 0.8;
  evidence.data_quality.flags = {"pv_quantised"};
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, VerdictCode::tight_tuning);
  EXPECT_THAT(verdict.action, testing::Not(HasSubstr("gain")));
  EXPECT_THAT(verdict.action, HasSubstr("transmitter"));
  EXPECT_THAT(verdict.reasons, Contains(HasSubstr("No advice on tuning")));
  evidence.oscillation = {};
  expect_verdict(evidence, VerdictCode::sensor_fault, std::nullopt);
}

TEST(SteplessVerdict, AnOversizedValveIsNamedByItsSpans) {
  Evidence evidence = plain(calm_loop());
  evidence.valve_gain = {0.6, 0.3};
  expect_verdict(evidence, VerdictCode::healthy, std::nullopt);
  oscillate(evidence, 130.0);
  expect_verdict(evidence, VerdictCode::valve_oversized, 1e-6);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
