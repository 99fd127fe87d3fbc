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
  evidence.data_quality.usable = false;
  evidence.hos.reset();
  EXPECT_EQ(decide(evidence, {}).code, Code::not_controlling) << "pv may be constant";
}

std::string still_words(const Evidence& evidence) {
  return state_text(LoopState::stands_still, evidence).at(0);
}

TEST(LoopStateWords, AMeasurementThatStandsStillIsToldWithItsPlaceAndWhatOpDoes) {
  Evidence evidence = recorded_evidence();
  evidence.still = still_of(4096);
  evidence.op_in_percent = true;
  EXPECT_EQ(still_words(evidence),
            "pv stands still at 49 for 4096 samples (68.3 min), all that was read, while op goes "
            "from 47 % to 100 % and the error stays at 1.");
  evidence.op_in_percent = evidence.still->whole = evidence.still->error_lasts = false;
  EXPECT_EQ(still_words(evidence),
            "pv stands still at 49 for 4096 samples (68.3 min), up to the window's end, while op "
            "goes from 47 to 100.");
  evidence.still->run = {0, 1000, 49.0};
  evidence.still->to_the_end = evidence.still->op_moves = false;
  evidence.still->error_lasts = true;
  EXPECT_EQ(still_words(evidence),
            "pv stood still at 49 for 1000 samples (16.7 min), until 3096 samples (51.6 min) "
            "before the window's end, while the error stays at 1.");
  evidence.samples = 1001;
  EXPECT_EQ(still_words(evidence),
            "pv stood still at 49 for 1000 samples (16.7 min), until 1 sample (1 s) before the "
            "window's end, while the error stays at 1.");
}

TEST(LoopStateWords, AMeasurementIsComparedWithAnother) {
  Evidence evidence = recorded_evidence();
  evidence.still = still_of(2000);
  EXPECT_EQ(frozen_summary(evidence), "The measurement stands still.");
  evidence.control.wound_up_percent = 100.0;
  EXPECT_EQ(frozen_summary(evidence),
            "The measurement stands still, and the controller has wound up to 100 %.");
  evidence.still->to_the_end = false;
  EXPECT_EQ(frozen_summary(evidence), "The measurement stood still for a while.");
  EXPECT_EQ(frozen_action(),
            "Compare pv with a second measurement or the local gauge; check transmitter, impulse "
            "lines and the line to the archive. Where the process itself stands (pump off, line "
            "shut), take the loop out of service.");
}

TEST(LoopStateWords, AnOutputAtItsEndIsToldWithHowFarItWoundUp) {
  Evidence evidence = recorded_evidence();
  evidence.control.at_limit_fraction = 0.9;
  const std::string text =
      "op is at an end of its range in 90 % of the samples and the error does not go away";
  EXPECT_THAT(state_text(LoopState::held_at_limit, evidence), testing::ElementsAre(text + "."));
  evidence.control.wound_up_percent = 0.0;
  EXPECT_THAT(state_text(LoopState::held_at_limit, evidence),
              testing::ElementsAre(text + ": the controller has wound up to 0 %."));
}

TEST(LoopStateWords, WhereNoControllerActsItIsSaidHowLongAndWhatToDo) {
  Evidence evidence = recorded_evidence();
  evidence.control.acting_fraction = 0.25;
  evidence.control.reason = signal::NotActing::mode;
  const auto lost = [&] { return state_text(LoopState::not_controlling, evidence).at(0); };
  const std::string by_mode =
      "The controller was in manual, tracking or out of service for 75 % of the window";
  EXPECT_EQ(lost(), by_mode + ".");
  EXPECT_EQ(not_controlling_summary(evidence),
            "For most of the window no controller acted on the loop.");
  EXPECT_EQ(not_controlling_action(evidence),
            "The controller acts again: wait for a window with it in service.");
  evidence.control.lost_at = 1024;
  EXPECT_EQ(lost(), by_mode + ", and throughout the last 3072 samples (51.2 min).");
  EXPECT_EQ(not_controlling_summary(evidence),
            "No controller acts on the loop: manual, tracking or out of service.");
  EXPECT_EQ(not_controlling_action(evidence),
            "Ask operations why it is not in automatic. If this is meant to last, disable the "
            "loop in the catalogue.");
  evidence.control.reason = signal::NotActing::constant_output;
  EXPECT_EQ(lost(),
            "The controller output stood still for 75 % of the window, and throughout the last "
            "3072 samples (51.2 min).");
  EXPECT_EQ(not_controlling_summary(evidence),
            "No controller acts on the loop: its output is constant.");
  EXPECT_EQ(not_controlling_action(evidence),
            "Check the controller's mode (manual, tracking, out of service) and the output's tag. "
            "If this is meant to last, disable the loop in the catalogue.");
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
