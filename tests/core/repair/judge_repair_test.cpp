#include "core/repair/judge_repair.hpp"

#include <gmock/gmock.h>

#include "tests/core/repair/repair_sample.hpp"

/// A test for each row of the table of outcomes in core/repair/README.md.
namespace loopscope::core::repair {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Outcome outcome(const Side& before, const Side& after) {
  return judge_repair(repair_between(before, after)).outcome.value();
}

/// A controller's gain, in every window of a side.
void set_gain(std::vector<RepairWindow>& windows, double gain) {
  for (RepairWindow& window : windows) {
    window.controller_gain = gain;
    window.integral_time_s = 20.0;
  }
}

RepairJudgement retuned(const Side& before, const Side& after, double gain_ratio) {
  RepairWindows windows = repair_between(before, after);
  set_gain(windows.before, 1.0);
  set_gain(windows.after, gain_ratio);
  return judge_repair(windows);
}

const Side kCurved{"process_nonlinearity", "curve"};
const Side kSlow{"sluggish_tuning", "slowness"};
const Side kDead{"valve_deadband", "friction"};
const Side kNameless{"nonlinear_unexplained", "unknown"};

TEST(JudgeRepair, FixedWhenTheFaultIsGone) {
  EXPECT_EQ(outcome(with_error(kSticks, 4.0, 0.2), with_error(kSound, 1.0, 0.8)), Outcome::fixed);
  EXPECT_EQ(outcome(kSticks, kSound), Outcome::fixed) << "at the same error";
}

TEST(JudgeRepair, FixedWithAdviceOnTuningLeft) {
  const auto judged = judge_repair(repair_between(kSticks, kSlow));
  EXPECT_EQ(judged.outcome, Outcome::fixed);
  EXPECT_THAT(judged.statement, HasSubstr("What is left: sluggish tuning (2 of 2 windows)."));
}

TEST(JudgeRepair, AnUnsureFaultWithoutHardwareHasToCostLess) {
  const Side unsure = with_confidence(kTight, 0.5);
  EXPECT_EQ(outcome(unsure, kSound), Outcome::unchanged);
  EXPECT_EQ(outcome(unsure, with_error(kSound, 0.8, 0.6)), Outcome::fixed);
  EXPECT_EQ(outcome(kTight, kSound), Outcome::fixed) << "a sure one is gone by its verdict";
}

TEST(JudgeRepair, GoneAtASignificantlyLargerErrorIsWorse) {
  EXPECT_EQ(outcome(kSticks, with_error(kSound, 3.0, 0.3)), Outcome::worse);
}

TEST(JudgeRepair, ImprovedWhenTheSizeIsLess) {
  const auto band = [](double width) { return EffectParameter{"valve_deadband", "width", width}; };
  EXPECT_EQ(
      outcome(with_effect(kSticks, {"valve_stiction", "S", 5.0}), with_effect(kDead, band(1.5))),
      Outcome::improved)
      << "stick band and dead band are one size";
  EXPECT_EQ(outcome(with_effect(kDead, band(1.5)), with_effect(kDead, band(5.0))), Outcome::worse);
  EXPECT_EQ(outcome(with_effect(kDead, band(3.0)), with_effect(kDead, band(3.1))),
            Outcome::unchanged);
}

TEST(JudgeRepair, ASizeInPercentOfOpMeansNothingAcrossAnotherValve) {
  Side large{"valve_oversized", "friction"};
  const EffectParameter before{"valve_deadband", "width", 1.0},
      after{"valve_deadband", "width", 5.0};
  EXPECT_EQ(outcome(with_effect(large, before), with_effect(kDead, after)), Outcome::unchanged);
  EXPECT_EQ(retuned(with_effect(kDead, before), with_effect(kDead, after), 2.0).outcome,
            Outcome::unchanged)
      << "nor across another controller";
}

TEST(JudgeRepair, ImprovedAndWorseByWhatTheSameFaultCosts) {
  EXPECT_EQ(outcome(with_error(kSticks, 3.0, 0.2), with_error(kSticks, 1.5, 0.4)),
            Outcome::improved);
  EXPECT_EQ(outcome(with_error(kSticks, 1.5, 0.4), with_error(kSticks, 3.0, 0.2)), Outcome::worse);
  EXPECT_EQ(outcome(with_error(kSticks, 1.0, 0.5), with_error(kSticks, 1.1, 0.5)),
            Outcome::unchanged);
}

TEST(JudgeRepair, MoreLoadAloneIsNotWorse) {
  EXPECT_EQ(outcome(with_error(kSticks, 1.0, 0.5), with_error(kSticks, 1.4, 0.6)),
            Outcome::unchanged)
      << "the Harris index rises with what no controller could remove";
}

TEST(JudgeRepair, AKnownAndEqualSizeSpeaksAgainstAChangeOfCost) {
  const EffectParameter band{"valve_stiction", "S", 3.0};
  const Side before = with_error(kSticks, 1.0, 0.5), after = with_error(kSticks, 1.25, 0.4);
  EXPECT_EQ(outcome(before, after), Outcome::worse);
  EXPECT_EQ(outcome(with_effect(before, band), with_effect(after, band)), Outcome::unchanged);
}

TEST(JudgeRepair, TheDirectionOfANewTuningDecides) {
  EXPECT_EQ(retuned(kTight, kTight, 0.5).outcome, Outcome::improved);
  EXPECT_EQ(retuned(kTight, kTight, 2.0).outcome, Outcome::worse);
  EXPECT_EQ(retuned(kSlow, kSlow, 2.0).outcome, Outcome::improved);
  EXPECT_EQ(retuned(kSlow, kSlow, 0.5).outcome, Outcome::worse);
  EXPECT_EQ(retuned(kTight, kTight, 1.0).outcome, Outcome::unchanged);
}

TEST(JudgeRepair, ATuningFaultUnderTheSameControllerAsksTwiceTheCost) {
  const Side before = with_error(kTight, 1.0, 0.5), after = with_error(kTight, 1.3, 0.4);
  EXPECT_EQ(retuned(before, after, 1.0).outcome, Outcome::unchanged);
  EXPECT_EQ(outcome(with_error(kSticks, 1.0, 0.5), with_error(kSticks, 1.3, 0.4)), Outcome::worse)
      << "of a valve it would do";
}

TEST(JudgeRepair, AnotherFaultOfHardwareIsWorseUnlessItCostsClearlyLess) {
  const Side held{"sensor_fault", "sensor"};
  EXPECT_EQ(outcome(kTight, held), Outcome::worse);
  EXPECT_EQ(outcome(with_error(kTight, 2.0, 0.3), with_error(held, 1.0, 0.6)), Outcome::improved);
}

TEST(JudgeRepair, ARepairedValveThatLeavesANamelessNonlinearityIsNotProvenGone) {
  EXPECT_EQ(outcome(with_error(kSticks, 3.0, 0.2), with_error(kNameless, 1.0, 0.6)),
            Outcome::improved);
  EXPECT_EQ(outcome(kSticks, kNameless), Outcome::unchanged);
  EXPECT_EQ(outcome(kNameless, kCurved), Outcome::unchanged) << "it has a name now";
}

TEST(JudgeRepair, WorseWhenSomethingNewIsBroken) {
  EXPECT_EQ(outcome(kSound, kDead), Outcome::worse);
  EXPECT_EQ(outcome(kSound, with_error(kTight, 1.1, 0.5)), Outcome::worse) << "a sure one";
  EXPECT_EQ(outcome(kSound, with_error(with_confidence(kTight, 0.5), 1.1, 0.5)),
            Outcome::unchanged);
  EXPECT_EQ(outcome(kSound, with_error(kSound, 2.5, 0.2)), Outcome::worse) << "by its cost alone";
}

TEST(JudgeRepair, SoundAtLessCostIsImprovedAndASuspicionThatLeavesIsFixed) {
  const Side after = with_error(kSound, 0.5, 0.8);
  EXPECT_EQ(outcome(kSound, after), Outcome::improved);
  const auto judged = judge_repair(repair_between(with_confidence(kSticks, 0.2), after));
  EXPECT_EQ(judged.outcome, Outcome::fixed);
  EXPECT_FALSE(judged.fault_before);
  EXPECT_THAT(judged.statement,
              StartsWith("Fixed: valve stiction, which was suspected before, is"));
}

TEST(JudgeRepair, EverythingElseIsUnchanged) {
  EXPECT_EQ(outcome(kSound, kSound), Outcome::unchanged);
  EXPECT_EQ(outcome(kSticks, kSticks), Outcome::unchanged);
  EXPECT_EQ(outcome(with_confidence(kSticks, 0.2), with_confidence(kSticks, 0.2)),
            Outcome::unchanged);
}

TEST(JudgeRepair, NothingIsSaidWithoutWindowsOnBothSides) {
  RepairWindows windows;
  RepairJudgement judged = judge_repair(windows);
  EXPECT_FALSE(judged.outcome);
  EXPECT_THAT(judged.statement, StartsWith("Cannot be compared: no usable window"));
  windows.before = windows_of(kSticks);
  EXPECT_THAT(judge_repair(windows).statement,
              StartsWith("Not judged yet: no window lies wholly after the work"));
  windows.refused = "pv is constant";
  judged = judge_repair(windows);
  EXPECT_FALSE(judged.outcome);
  EXPECT_THAT(judged.statement, HasSubstr("cannot be used: pv is constant."));
  EXPECT_EQ(judged.windows_before, 2U);
}

TEST(JudgeRepair, WindowsWithoutFiguresOrFromAnEarlierProgramCount) {
  RepairWindows windows = repair_between(kSticks, kSound);
  for (auto* side : {&windows.before, &windows.after})
    for (RepairWindow& window : *side) window.error_std = window.harris = std::nullopt;
  const RepairJudgement judged = judge_repair(windows);
  EXPECT_EQ(judged.outcome, Outcome::fixed);
  EXPECT_FALSE(judged.variance_ratio());
  EXPECT_THAT(judged.statement, StartsWith("Fixed: valve stiction, which stood in 2 of 2"));
}

TEST(JudgeRepair, TheVarianceRatioIsTheSquareOfTheDeviations) {
  const auto ratio =
      judge_repair(repair_between(with_error(kSticks, 4.0, 0.2), with_error(kSound, 1.0, 0.8)))
          .variance_ratio();
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->value, 0.0625, 1e-12);
  EXPECT_LT(ratio->low, ratio->value);
  EXPECT_LT(ratio->high, 1.0);
}

}  // namespace
}  // namespace loopscope::core::repair
