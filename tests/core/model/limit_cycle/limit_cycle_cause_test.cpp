#include "core/model/limit_cycle/limit_cycle_cause.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/core/model/family_balance.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/core/model/limit_cycle_shares.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kNaN;

using Balance = loopscope::tests::model::FamilyBalance;
using loopscope::tests::model::field_families;
using loopscope::tests::model::FieldFamily;
using loopscope::tests::model::FieldLoop;
using loopscope::tests::model::record_of;
using tests::judge;
using tests::right_share;
using enum CycleCause::Decision;

TEST(LimitCycleCause, FamiliesThatTheScoreHasNotSeen) {
  Balance balance;
  for (const FieldFamily& family : field_families()) {
    if (!family.for_tuning) balance.add(family.sticks, right_share(family, 12));
  }
  EXPECT_GT(balance.sensitivity(), 0.8);
  EXPECT_GT(balance.specificity(), 0.8);
}

TEST(LimitCycleCause, ScaleAndOffsetDoNotMatter) {
  FieldLoop loop = record_of(field_families().front(), 3);
  const CycleCause plain = judge(loop);
  for (double& value : loop.pv) value = 250.0 * value - 40.0;
  for (double& value : loop.sp) value = 250.0 * value - 40.0;
  for (double& value : loop.op) value = 0.16 * value + 4.0;
  const CycleCause scaled = judge(loop);
  EXPECT_NEAR(scaled.score, plain.score, 1e-6);
  EXPECT_NEAR(scaled.evidence.stickband, 0.16 * plain.evidence.stickband, 1e-9);
}

TEST(LimitCycleCause, SurvivesMissingSamples) {
  FieldLoop loop = record_of(field_families().front(), 3);
  for (std::size_t k = 0; k < loop.pv.size(); k += 17) loop.pv[k] = kNaN;
  for (std::size_t k = 5; k < loop.op.size(); k += 31) loop.op[k] = kNaN;
  loop.pv.front() = loop.op.back() = kNaN;
  const CycleCause cause = judge(loop);
  EXPECT_NE(cause.decision, undecided);
  EXPECT_TRUE(std::isfinite(cause.score));
}

TEST(LimitCycleCause, UndecidedWhereNothingCanBeSaid) {
  const std::vector<double> still(1000, 3.0);
  std::vector<double> moving(1000);
  for (std::size_t k = 0; k < moving.size(); ++k)
    moving[k] = std::sin(0.3 * static_cast<double>(k));
  EXPECT_EQ(judge_limit_cycle(moving, still, {}).decision, undecided);
  EXPECT_EQ(judge_limit_cycle(still, moving, {}).decision, undecided);
  const std::vector<double> nothing(1000, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(judge_limit_cycle(nothing, nothing, nothing).decision, undecided);
  EXPECT_EQ(judge_limit_cycle({}, {}, {}).decision, undecided);
  EXPECT_THROW((void)judge_limit_cycle(moving, std::vector<double>(3), {}), std::invalid_argument);
}

constexpr std::size_t kCycleSamples = 2000;

std::vector<double> wave(double amplitude, double cycles) {
  std::vector<double> result;
  for (std::size_t k = 0; k < kCycleSamples; ++k) {
    const double turn = 2.0 * std::numbers::pi * cycles * static_cast<double>(k) / kCycleSamples;
    result.push_back(50.0 + amplitude * std::sin(turn));
  }
  return result;
}

/// pv swings by 1, ten times; sp as said.
bool driven(const std::vector<double>& sp) {
  const std::vector<double> pv = wave(1.0, 10.0);
  ModelInput input;
  input.pv = pv;
  input.sp = sp;
  CycleEvidence cycle;
  cycle.cycles = 10.0;
  return driven_by_setpoint(input, cycle);
}

TEST(DrivenCycle, AsOftenAsTheSetpointTurns) {
  EXPECT_TRUE(driven(wave(1.0, 10.0)));
  EXPECT_TRUE(driven(wave(1.0, 8.0)));
}

TEST(DrivenCycle, TwiceAsOftenIsTheLoopsOwn) {
  EXPECT_FALSE(driven(wave(1.0, 5.0)));
  EXPECT_FALSE(driven(wave(1.0, 2.0)));
}

TEST(DrivenCycle, ASetpointThatHardlyMovesOrIsNotRecordedDrivesNothing) {
  EXPECT_FALSE(driven(wave(0.05, 10.0)));
  EXPECT_FALSE(driven(std::vector<double>(kCycleSamples, 50.0)));
  EXPECT_FALSE(driven({}));
}

}  // namespace
}  // namespace loopscope::core::model
