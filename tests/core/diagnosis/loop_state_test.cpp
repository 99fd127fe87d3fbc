#include "core/diagnosis/loop_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/odds/combined_odds.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Code = VerdictCode;
using testing::HasSubstr;
using testing::IsEmpty;

Evidence recorded_evidence() {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.enough = true;
  evidence.samples = 4096;
  return evidence;
}

signal::StandStill still_of(std::size_t samples) {
  signal::StandStill still;
  still.run = {4096 - samples, samples, 49.0};
  still.to_the_end = still.op_moves = still.error_lasts = true;
  still.whole = samples == 4096;
  still.error = 1.0;
  still.op_low = 47.0;
  still.op_high = 100.0;
  return still;
}

TEST(LoopState, AMeasurementThatStandsStillGoesBeforeEverything) {
  Evidence evidence = recorded_evidence();
  evidence.still = still_of(4096);
  evidence.control.wound_up_percent = 100.0;
  evidence.control.held_at_limit = true;
  evidence.data_quality.usable = false;
  evidence.hos.reset();
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::sensor_fault);
  EXPECT_GT(verdict.confidence, 0.9);
  EXPECT_LT(verdict.confidence, 1.0);
  EXPECT_THAT(verdict.summary, HasSubstr("wound up to 100 %"));
  EXPECT_THAT(verdict.reasons.at(0), HasSubstr("stands still at 49 for 4096 samples"));
  EXPECT_THAT(verdict.reasons.at(1), HasSubstr("wound up to 100 %"));
  EXPECT_EQ(verdict.p, std::nullopt);
  EXPECT_THAT(evidence_of(verdict), IsEmpty()) << "no other window weakens it";
}

TEST(LoopState, WhatIsOverIsToldAsOver) {
  Evidence evidence = recorded_evidence();
  evidence.still = still_of(1000);
  evidence.still->run.first = 500;
  evidence.still->to_the_end = false;
  evidence.control.wound_up_percent = 100.0;
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::sensor_fault);
  EXPECT_THAT(verdict.summary, HasSubstr("stood still for a while"));
  EXPECT_THAT(verdict.reasons.at(0), HasSubstr("until 2596 samples"));
}

TEST(LoopState, BesideStatisticsTooAndHealthIsWhatIsLeft) {
  Evidence evidence = recorded_evidence();
  evidence.still = still_of(2000);
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::sensor_fault);
  for (const CauseReport& cause : verdict.causes) {
    if (cause.code != Code::healthy) continue;
    EXPECT_LE(cause.probability, 1.0 - verdict.confidence + 1e-9);
  }
}

TEST(LoopState, AnOutputAtItsEndIsSaturation) {
  Evidence evidence = recorded_evidence();
  evidence.control.held_at_limit = true;
  evidence.control.at_limit_fraction = evidence.data_quality.saturated_fraction = 0.9;
  evidence.data_quality.flags = {"sp_not_followed", "op_constant"};
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::valve_saturation);
  EXPECT_GT(verdict.confidence, 0.9);
  evidence.control.acting_fraction = 0.0;
  evidence.control.reason = signal::NotActing::mode;
  EXPECT_EQ(decide(evidence, {}).code, Code::not_controlling) << "an operator holds it there";
  evidence.control.acting_fraction = 0.9;
  EXPECT_EQ(decide(evidence, {}).code, Code::valve_saturation) << "and did so for a while only";
}

TEST(LoopState, WithoutAControllerNothingIsAFaultAndNothingIsHealthy) {
  Evidence evidence = recorded_evidence();
  evidence.control.acting_fraction = 0.25;
  evidence.control.reason = signal::NotActing::constant_output;
  evidence.control.lost_at = 1024;
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::not_controlling);
  EXPECT_EQ(verdict.confidence, 1.0);
  EXPECT_THAT(verdict.causes, IsEmpty());
  EXPECT_THAT(verdict.reasons.at(0), HasSubstr("75 % of the window"));
  EXPECT_THAT(verdict.reasons.at(0), HasSubstr("for the last 3072 samples"));
  evidence.data_quality.usable = false;
  evidence.hos.reset();
  EXPECT_EQ(decide(evidence, {}).code, Code::not_controlling) << "pv may be constant";
}

TEST(LoopState, TooLittleRecordedIsNoState) {
  Evidence evidence = recorded_evidence();
  evidence.data_quality.enough = evidence.data_quality.usable = false;
  evidence.still = still_of(4096);
  EXPECT_EQ(state_of(evidence), LoopState::none);
  EXPECT_EQ(decide(evidence, {}).code, Code::insufficient_data);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
