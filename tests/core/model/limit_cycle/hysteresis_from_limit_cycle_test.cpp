#include "core/model/limit_cycle/hysteresis_from_limit_cycle.hpp"

#include <cstdio>
#include <functional>
#include <gtest/gtest.h>

#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

std::vector<TestOutcome> witness(double p) {
  TestOutcome answer;
  answer.question = {"op_direction", p, ""};
  return {answer};
}

using tests::kManyTurns;

int accused(const char* scenario, double p, int seeds) {
  int count = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto record = simulate::simulate_scenario(scenario, {}, static_cast<std::uint64_t>(seed));
    const ModelInput input{record.pv, record.op, record.sp, {}, record.sample_interval_s, true, 1};
    count += find_hysteresis(input, witness(p), kManyTurns) ? 1 : 0;
  }
  std::printf("| %s | p %.3g | %d of %d |\n", scenario, p, count, seeds);
  return count;
}

TEST(HysteresisStep, NeedsTheWitnessOfTheResidual) {
  EXPECT_EQ(accused("square_limit_cycle", 0.2, 5), 0);
  EXPECT_GE(accused("square_limit_cycle", 1e-6, 5), 4);
}

/// With the witness bribed the judge of limit cycles stands alone, and errs on slow healthy loops.
TEST(HysteresisStep, TheWitnessAloneSeldomAccusesAValve) {
  EXPECT_LE(accused("healthy_flow", 1e-6, 60), 10);
  EXPECT_LE(accused("outside_oscillation", 1e-6, 60), 3);
}

TEST(HysteresisStep, AHealthyLoopIsNotAccusedByBoth) {
  EXPECT_EQ(accused("healthy_flow", 0.2, 20), 0);
}

TEST(HysteresisStep, LowersTheErrorAndSaysSo) {
  const auto record = simulate::simulate_scenario("square_limit_cycle", {}, 1);
  const ModelInput input{record.pv, record.op, record.sp, {}, record.sample_interval_s, true, 1};
  const auto step = find_hysteresis(input, witness(1e-6), kManyTurns);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->effect, EffectKind::valve_stiction);
  EXPECT_LT(step->holdout_error_after, 0.95 * step->holdout_error_before);
  EXPECT_EQ(step->p, 1e-6);
  EXPECT_EQ(step->statement,
            "The valve sticks. A valve that moves where op turns leaves 0.14 of the error that a "
            "linear process leaves (median of the record's parts; less in 90 % of them). On "
            "held-out samples a valve with S 4.01 % and J 3.61 % leaves 0.14 of pv's variance, a "
            "linear process 0.13. op repeats its half cycle to 99 %, triangularity 0.11 (0 sine, "
            "0.11 triangle); wave shape index of pv 0.34.");
}

}  // namespace
}  // namespace loopscope::core::model
