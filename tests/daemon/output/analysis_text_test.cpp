#include "daemon/output/analysis_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

core::Diagnosis judged() {
  core::Diagnosis diagnosis;
  diagnosis.evidence.hos.emplace().segments = 127;
  return diagnosis;
}

TEST(AnalysisText, TheSlowLookHasALineWithPeriodsInSeconds) {
  core::Diagnosis diagnosis = judged();
  EXPECT_THAT(analysis_text("f.csv", 10.0, diagnosis), Not(HasSubstr("decimated")));
  core::hos::Result result;
  result.segments = 60;
  result.ngi = 0.05;
  result.peaks = {{0.125, 0.0625, 0.5, std::nullopt}};
  diagnosis.evidence.hos_slow = core::hos::SlowLook{17, 8976, result};
  const std::string text = analysis_text("f.csv", 10.0, diagnosis);
  EXPECT_THAT(text, HasSubstr("decimated     NGI 0.0500, NLI 0.0000, p - over 60 segments of 8976 "
                              "samples decimated by 17"));
  EXPECT_THAT(text, HasSubstr("periods 1360 s and 2720 s"));
}

TEST(AnalysisText, TheModelHasASectionWhenThereIsOne) {
  core::Diagnosis diagnosis = judged();
  EXPECT_THAT(analysis_text("f.csv", 10.0, diagnosis), Not(HasSubstr("\n  model ")));
  diagnosis.evidence.model.emplace().excited = true;
  EXPECT_THAT(analysis_text("f.csv", 10.0, diagnosis), HasSubstr("\n  model "));
}

}  // namespace
}  // namespace loopscope::daemon
