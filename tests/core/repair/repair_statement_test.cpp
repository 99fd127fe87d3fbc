#include "core/repair/repair_statement.hpp"

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

TEST(RepairStatement, SaysWhatIsNew) {
  EXPECT_EQ(said(repair_between(kSound, kSticks)).substr(0, 76),
            "Worse: valve stiction (2 of 2 windows) is new, before there was no fault; th");
  EXPECT_EQ(said(repair_between(kTight, kSticks)).substr(0, 76),
            "Worse: valve stiction (2 of 2 windows) stands, before it was tight tuning; t");
}

TEST(RepairStatement, SaysThatNothingStandsAndWhatDid) {
  EXPECT_EQ(said(repair_between(kSound, kSound)).substr(0, 31), "Unchanged: no fault stands; the");
  EXPECT_EQ(said(repair_between(with_confidence(kTight, 0.5), kSound)).substr(0, 55),
            "Unchanged: no fault stands, before it was tight tuning;");
}

TEST(RepairStatement, SaysWhatWasOnlySuspected) {
  EXPECT_EQ(said(repair_between(with_confidence(kSticks, 0.2), kSticks)).substr(0, 80),
            "Worse: valve stiction (2 of 2 windows) stands, before valve stiction was suspect");
}

TEST(RepairStatement, SaysThatWindowsAfterStillNameTheFault) {
  RepairWindows windows = repair_between(kSticks, with_confidence(kSound, 0.95));
  windows.after.push_back(windows.before.front());
  EXPECT_EQ(said(windows).substr(0, 115),
            "Fixed: valve stiction, which stood in 2 of 2 windows before, no longer stands, though "
            "1 of 3 windows after name it;");
}

TEST(RepairStatement, SaysThatTheFaultIsGoneWhereTheErrorIsWorse) {
  EXPECT_EQ(said(repair_between(kSticks, with_error(kSound, 3.0, 0.3))).substr(0, 104),
            "Worse: valve stiction, which stood in 2 of 2 windows before, is gone, but " +
                kError.substr(0, 30));
}

TEST(RepairStatement, AFaultWithoutANameIsCalledThat) {
  EXPECT_EQ(said(repair_between({"unexplained", "unknown"}, kSound)).substr(0, 44),
            "Fixed: a fault without a known cause, which ");
}

TEST(RepairStatement, SaysThatAFaultIsBack) {
  RepairWindows windows = repair_between(kSticks, kSound);
  windows.newest = {"friction", 0.9, "2026-01-02 16:00"};
  EXPECT_NE(said(windows).find("It is back in the newest window, of 2026-01-02 16:00 UTC."),
            std::string::npos);
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
