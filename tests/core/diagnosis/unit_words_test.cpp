#include "core/diagnosis/unit_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/diagnosis/decide.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using testing::Contains;
using testing::HasSubstr;

loop::UnitMatch degrees(double probability, bool follows) {
  return {.probability = probability,
          .conversion = {"converted from degF to degC", 1.0 / 1.8, -32.0 / 1.8, 0.2},
          .sp_mean = 70.3,
          .pv_mean = 21.3,
          .slope = follows ? 0.555 : 0.0,
          .offset = follows ? -17.7 : 21.3,
          .residual = 0.21,
          .follows = follows};
}

TEST(UnitWords, UnitsAreADoubtWhereTheSetpointRests) {
  Evidence evidence = quiet_evidence();
  evidence.units = degrees(0.8, false);
  EXPECT_NE(decide(evidence, {}).code, VerdictCode::unexplained) << "pv is at its setpoint";
  evidence.data_quality.flags = {"sp_not_followed"};
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, VerdictCode::unexplained);
  EXPECT_EQ(verdict.summary, "The controller is not in command, or has no integral action.");
  EXPECT_EQ(verdict.reasons.at(1),
            "sp and pv may be in different units: pv is 21.3 where sp is 70.3, and 70.3 converted "
            "from degF to degC is 21.3.");
  EXPECT_EQ(verdict.action,
            "Compare the units of setpoint and pv; then check whether an override or another "
            "controller holds the valve; if that is meant, disable the loop in the catalogue.");
  evidence.units->probability = 0.4;
  EXPECT_THAT(decide(evidence, {}).reasons, testing::Not(Contains(HasSubstr("different units"))));
}

TEST(UnitWords, UnitsThatTheSetpointsMovesShowAreTheVerdict) {
  Evidence evidence = quiet_evidence();
  evidence.units = degrees(0.998, true);
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, VerdictCode::unexplained);
  EXPECT_EQ(verdict.confidence, 0.998);
  EXPECT_EQ(verdict.summary, "The setpoint is recorded in another unit than pv.");
  EXPECT_EQ(verdict.reasons.front(),
            "sp and pv are in different units: where the setpoint moves, pv is -17.7 + 0.555 sp to "
            "within 0.21, and 70.3 converted from degF to degC is 21.3.");
  EXPECT_EQ(verdict.action,
            "Record the setpoint in the unit of pv, or convert it in a view that the historian's "
            "table is read through; what else is said of this loop counts only after that.");
  EXPECT_EQ(verdict.p, std::nullopt);
  evidence.units->conversion = {"times 10", 10.0, 0.0, 0.04};
  evidence.units->slope = 9.98;
  evidence.units->offset = 0.1;
  evidence.units->sp_mean = 2.13;
  EXPECT_THAT(decide(evidence, {}).reasons.front(),
              HasSubstr("pv is 9.98 sp to within 0.21, and 2.13 times 10 is 21.3."));
  evidence.units->probability = 0.98;
  EXPECT_NE(decide(evidence, {}).code, VerdictCode::unexplained) << "not sure enough";
}

TEST(UnitWords, NothingIsSaidWithoutASetpoint) {
  EXPECT_EQ(unit_finding(quiet_evidence()), UnitFinding::none);
  EXPECT_EQ(unit_reason(quiet_evidence()), "");
}

}  // namespace
}  // namespace loopscope::core::diagnosis
