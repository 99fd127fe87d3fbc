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

TEST(AnalysisText, EveryLineOfAWindowWithoutAModel) {
  core::Diagnosis diagnosis = judged();
  diagnosis.verdict.code = core::diagnosis::VerdictCode::valve_stiction;
  diagnosis.verdict.confidence = 0.823;
  diagnosis.verdict.summary = "The control valve sticks.";
  diagnosis.verdict.reasons = {"It jumps.", "It stands still."};
  diagnosis.verdict.action = "Repair it.";
  core::Evidence& evidence = diagnosis.evidence;
  evidence.hos->ngi = 0.0213;
  evidence.hos->nli = 0.31;
  evidence.hos->bifrequencies = 1024;
  evidence.hos->published = {false, false};
  evidence.hos->peaks = {{0.125, 0.0625, 0.5, std::nullopt}};
  evidence.oscillation = {true, 120.0, 4.5, 1.25, 0.9, 1e-6};
  evidence.performance.harris_low = 0.25;
  evidence.performance.harris_high = 0.5;
  evidence.performance.error_std = 0.75;
  evidence.data_quality.flags = {"short", "pv_held"};
  EXPECT_EQ(analysis_text("f.csv", 10.0, diagnosis),
            "f.csv\n"
            "  valve_stiction (confidence 0.82): The control valve sticks.\n"
            "    - It jumps.\n"
            "    - It stands still.\n"
            "  What to do: Repair it.\n"
            "\n"
            "  statistics    NGI 0.0213, NLI 0.3100 over 127 segments and 1024 bifrequencies; "
            "published rule: non-Gaussian, nonlinear\n"
            "  peak          bic2 0.500 at (0.1250, 0.0625) cycles per sample: periods 80 s and "
            "160 s\n"
            "  oscillation   present; period 120 s, regularity 4.5, persistence 0.9, amplitude "
            "1.25 units of pv\n"
            "  performance   Harris 0.25 to 0.5; error std 0.75 units of pv; valve travel - %/h, - "
            "reversals/h; op at a limit -\n"
            "  shape         shape index -, Horch dtau - drho -, ellipse - %, mv-op width - %\n"
            "  data          missing -, flags: short, pv_held\n");
  evidence.oscillation = {};
  evidence.hos->published = {true, true};
  evidence.data_quality.missing_fraction = 0.025;
  evidence.data_quality.flags.clear();
  evidence.performance.at_limit_fraction = 0.3;
  const std::string calm = analysis_text("f.csv", 10.0, diagnosis);
  EXPECT_THAT(calm, HasSubstr("; published rule: Gaussian, no nonlinearity shown\n"));
  EXPECT_THAT(calm, HasSubstr("  oscillation   none found\n"));
  evidence.oscillation.period_s = 35.0;
  EXPECT_THAT(analysis_text("f.csv", 10.0, diagnosis),
              HasSubstr("  oscillation   none found; best candidate: period 35 s, regularity -, "
                        "persistence -, amplitude -\n"));
  EXPECT_THAT(calm, HasSubstr("; op at a limit 30 %\n"));
  EXPECT_THAT(calm, HasSubstr("  data          missing 2.5 %, flags: none\n"));
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
