#include "core/repair/repair_statement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/repair/repair_sample.hpp"

namespace loopscope::core::repair {
namespace {

std::string said(const RepairWindows& windows) {
  return judge_repair(windows).statement;
}

const std::string kError = "the error's standard deviation went from ";

TEST(RepairStatement, SaysWhatIsGoneAndByHowMuchTheErrorFell) {
  EXPECT_EQ(said(repair_between(with_error(kSticks, 4.0, 0.2), with_error(kSound, 1.0, 0.8))),
            "Fixed: valve stiction, which stood in 2 of 2 windows before, is gone; " + kError +
                "4 to 1 (x 0.25, 90 % interval 0.19 to 0.32).");
}

TEST(RepairStatement, SaysHowTheSizeChanged) {
  EXPECT_EQ(said(repair_between(with_effect(kSticks, {"valve_stiction", "S", 5.0}),
                                with_effect(kSticks, {"valve_stiction", "S", 1.5}))),
            "Improved: valve stiction (2 of 2 windows) is left, but less; its friction band went "
            "from 5 to 1.5; " +
                kError + "1 to 1 (x 1.00, 90 % interval 0.77 to 1.29).");
}

const std::string kSame = kError + "1 to 1 (x 1.00, 90 % interval 0.77 to 1.29).";

TEST(RepairStatement, SaysThatTheFaultStandsAsBeforeOrMore) {
  const auto sized = [](double before, double after) {
    return said(repair_between(with_effect(kSticks, {"valve_stiction", "S", before}),
                               with_effect(kSticks, {"valve_stiction", "S", after})));
  };
  EXPECT_EQ(sized(5.0, 5.0),
            "Unchanged: valve stiction (2 of 2 windows) stands as before; its friction band went "
            "from 5 to 5; " +
                kSame);
  EXPECT_EQ(sized(1.0, 5.0),
            "Worse: valve stiction (2 of 2 windows) still stands, and more; its friction band went "
            "from 1 to 5; " +
                kSame);
}

TEST(RepairStatement, SaysWhatIsNew) {
  EXPECT_EQ(said(repair_between(kSound, kSticks)),
            "Worse: valve stiction (2 of 2 windows) is new, before there was no fault; " + kSame);
  EXPECT_EQ(said(repair_between(kTight, kSticks)),
            "Worse: valve stiction (2 of 2 windows) stands, before it was tight tuning; " + kSame);
}

TEST(RepairStatement, SaysThatNothingStandsAndWhatDid) {
  EXPECT_EQ(said(repair_between(kSound, kSound)), "Unchanged: no fault stands; " + kSame);
  EXPECT_EQ(said(repair_between(with_confidence(kTight, 0.5), kSound)),
            "Unchanged: no fault stands, before it was tight tuning; " + kSame);
}

TEST(RepairStatement, SaysWhatWasOnlySuspected) {
  EXPECT_EQ(said(repair_between(with_confidence(kSticks, 0.2), kSticks)),
            "Worse: valve stiction (2 of 2 windows) stands, before valve stiction was suspected; " +
                kSame);
}

TEST(RepairStatement, OneWindowIsNoPlural) {
  Side one = kSticks;
  one.windows = 1;
  EXPECT_THAT(said(repair_between(one, one)),
              testing::StartsWith("Unchanged: valve stiction (1 of 1 window) stands as before; "));
}

TEST(RepairStatement, SaysWhyThereIsNoOutcome) {
  RepairWindows windows = repair_between(kSound, kSound);
  windows.after.clear();
  EXPECT_EQ(said(windows),
            "Not judged yet: no window lies wholly after the work and before the next.");
  windows.refused = "pv is constant";
  EXPECT_EQ(said(windows),
            "Not judged yet: the data after the work cannot be used: pv is constant.");
  windows.before.clear();
  EXPECT_EQ(said(windows),
            "Cannot be compared: no usable window of the loop from before this work, and after any "
            "earlier work, is known.");
}

TEST(RepairStatement, SaysThatTheErrorIsNotKnown) {
  RepairWindows windows = repair_between(kSound, kSound);
  for (RepairWindow& window : windows.before) window.error_std.reset();
  EXPECT_EQ(said(windows),
            "Unchanged: no fault stands; the error is not known on both sides of the work.");
}

TEST(RepairStatement, SaysThatWindowsAfterStillNameTheFault) {
  RepairWindows windows = repair_between(kSticks, with_confidence(kSound, 0.95));
  windows.after.push_back(windows.before.front());
  EXPECT_EQ(said(windows),
            "Fixed: valve stiction, which stood in 2 of 2 windows before, no longer stands, though "
            "1 of 3 windows after still names it; " +
                kError + "1 to 1 (x 1.00, 90 % interval 0.78 to 1.28).");
  windows.after.resize(5, windows.after.front());
  windows.after.push_back(windows.before.front());
  EXPECT_THAT(said(windows), testing::HasSubstr("2 of 6 windows after still name it; "));
}

TEST(RepairStatement, SaysThatTheFaultIsGoneWhereTheErrorIsWorse) {
  EXPECT_EQ(said(repair_between(kSticks, with_error(kSound, 3.0, 0.3))),
            "Worse: valve stiction, which stood in 2 of 2 windows before, is gone, but " + kError +
                "1 to 3 (x 3.00, 90 % interval 2.32 to 3.88).");
}

TEST(RepairStatement, AFaultWithoutANameIsCalledThat) {
  EXPECT_EQ(
      said(repair_between({"unexplained", "unknown"}, kSticks)),
      "Unchanged: valve stiction (2 of 2 windows) stands, before it was a fault without a known "
      "cause; " +
          kSame);
  EXPECT_EQ(said(repair_between({"nonlinear_unexplained", "unknown"}, kTight)),
            "Fixed: a nonlinearity without a known cause, which stood in 2 of 2 windows before, is "
            "gone; " +
                kSame + " What is left: tight tuning (2 of 2 windows).");
}

TEST(RepairStatement, SaysThatAFaultIsBack) {
  RepairWindows windows = repair_between(kSticks, kSound);
  windows.newest = {"friction", 0.9, "2026-01-02 16:00"};
  EXPECT_EQ(said(windows),
            "Fixed: valve stiction, which stood in 2 of 2 windows before, is gone; " + kSame +
                " It is back in the newest window, of 2026-01-02 16:00 UTC.");
  windows.newest->confidence = 0.2;
  EXPECT_EQ(said(windows).find("back"), std::string::npos) << "not by a doubtful verdict";
}

TEST(RepairStatement, WritesNumbersAsADisplayDoes) {
  const auto from = [](double error) {
    return said(repair_between(with_error(kSound, error, 0.5), with_error(kSound, error, 0.5)));
  };
  EXPECT_NE(from(12345.0).find("from 12300 to"), std::string::npos);
  EXPECT_NE(from(0.012345).find("from 0.0123 to"), std::string::npos);
  EXPECT_NE(from(1.2345e-7).find("from 1.23e-07 to"), std::string::npos);
  EXPECT_NE(from(1.2345e12).find("from 1.23e+12 to"), std::string::npos);
}

}  // namespace
}  // namespace loopscope::core::repair
