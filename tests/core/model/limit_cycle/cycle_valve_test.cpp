#include "core/model/limit_cycle/cycle_valve.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "tests/core/model/field_families.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::model::field_families;
using loopscope::tests::model::FieldFamily;
using loopscope::tests::model::FieldLoop;

CycleCause cause_of(double score, double travel) {
  CycleCause cause;
  cause.score = score;
  cause.evidence.travel = travel;
  return cause;
}

TEST(CycleValve, BothWitnessesCount) {
  EXPECT_GT(odds_that_valve_cycles(cause_of(0.9, 2.0), 1.6), 0.0);
  EXPECT_GT(odds_that_valve_cycles(cause_of(0.3, 2.0), 1.6), 0.0);
  EXPECT_LT(odds_that_valve_cycles(cause_of(0.9, 2.0), 0.2), 0.0);
  EXPECT_LT(odds_that_valve_cycles(cause_of(0.02, 2.0), 0.6), 0.0);
}

TEST(CycleValve, NothingStrangeWhereOpStoodStill) {
  EXPECT_LT(odds_that_valve_cycles(cause_of(0.5, 0.0), 1.0), 0.0);
  EXPECT_LT(odds_that_valve_cycles(cause_of(0.0, 1.0), 1.0), 0.0);
}

const FieldFamily& family(std::string_view name) {
  return *std::ranges::find(field_families(), name, &FieldFamily::name);
}

/// What becomes of a step of play whose width is that share of op's travel in the cycle.
bool marked(std::string_view name, std::uint64_t seed, double share) {
  const FieldLoop loop = record_of(family(name), seed);
  const ModelInput input{loop.pv, loop.op, loop.sp, {}, 1.0, true, 1};
  const double travel = judge_limit_cycle(loop.pv, loop.op, loop.sp).evidence.travel;
  Step step;
  step.effect = EffectKind::valve_deadband;
  step.parameters = {{"width", "%", share * travel, {}, {}}};
  std::vector<Step> steps{step};
  weigh_valves_by_cycle(input, steps);
  return steps.front().cycle_indicates_stiction;
}

int stiction_of_ten(std::string_view name, double share) {
  int count = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) count += marked(name, seed, share) ? 1 : 0;
  return count;
}

TEST(CycleValve, PlayAsWideAsTheCycleIsStiction) {
  EXPECT_GE(stiction_of_ten("stiction_flow_he", 0.8), 9);
}

/// A loop whose process integrates cycles about play as well.
TEST(CycleValve, InFrontOfAVesselPlayStaysPlay) {
  EXPECT_LE(stiction_of_ten("stiction_level_karnopp", 0.7), 1);
}

TEST(CycleEvidence, LagIsAShareOfAQuarterOfTheCycle) {
  CycleEvidence cycle;
  cycle.period_samples = 100.0;
  EXPECT_DOUBLE_EQ(cycle.process_lag(), 0.0);
  cycle.lag_samples = 50.0 / std::numbers::pi;
  EXPECT_NEAR(cycle.process_lag(), 0.5, 1e-12);
  cycle.lag_samples = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(cycle.process_lag(), 1.0);
}

TEST(CycleValve, ANarrowBandStaysPlay) {
  EXPECT_LE(stiction_of_ten("sine_flow", 0.05), 1);
}

/// The setpoint drives op to and fro across the play.
TEST(CycleValve, UnderAMovingSetpointOpHasToRepeatItself) {
  EXPECT_LE(stiction_of_ten("play_and_moves", 0.5), 1);
}

TEST(CycleValve, SaysWhatItSawAndKeepsTheErrors) {
  const FieldLoop loop = record_of(family("stiction_flow_he"), 3);
  const ModelInput input{loop.pv, loop.op, loop.sp, {}, 1.0, true, 1};
  Step play;
  play.effect = EffectKind::valve_deadband;
  play.evidence = 100.0;
  play.parameters = {
      {"width", "%", judge_limit_cycle(loop.pv, loop.op, loop.sp).evidence.travel, 0.1, 9.0}};
  std::vector<Step> steps{play};
  weigh_valves_by_cycle(input, steps);
  const Step& step = steps.front();
  EXPECT_TRUE(step.cycle_indicates_stiction);
  EXPECT_EQ(step.effect, EffectKind::valve_deadband);
  EXPECT_EQ(step.parameters[0].low, 0.1);
  EXPECT_EQ(step.evidence, 100.0);
  EXPECT_EQ(step.statement,
            " The loop keeps cycling across it, as a loop with a sticking valve does: the band is "
            "100 % of the controller output's travel, and the output repeats its half cycle to "
            "93 %.");
}

}  // namespace
}  // namespace loopscope::core::model
