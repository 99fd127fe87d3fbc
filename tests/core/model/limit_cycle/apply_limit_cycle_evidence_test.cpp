#include "core/model/limit_cycle/apply_limit_cycle_evidence.hpp"

#include <gtest/gtest.h>
#include <utility>

#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using enum EffectKind;

using tests::kManyTurns;

Step step_of(EffectKind effect, double before, double after) {
  Step step;
  step.effect = effect;
  step.parameters = {{"S", "%", 1.0, {}, {}}};
  step.holdout_error_before = before;
  step.holdout_error_after = after;
  return step;
}

/// What becomes of a model of these steps on a record of that scenario, op following its direction.
Explanation preferred(const char* scenario, std::vector<Step> steps) {
  const auto record = simulate::simulate_scenario(scenario, {}, 1);
  const ModelInput input{record.pv, record.op, record.sp, {}, record.sample_interval_s, true, 1};
  TestOutcome direction;
  direction.question = {"op_direction", 1e-6, ""};
  direction.nominations = {{.effect = valve_stiction, .p = 1e-6}};
  Explanation explanation;
  explanation.steps = std::move(steps);
  apply_limit_cycle_evidence(input, {direction}, {direction}, kManyTurns, explanation);
  return explanation;
}

bool by_cycle(const Explanation& explanation) {
  return explanation.error_kind == ErrorKind::simulation && explanation.steps.size() == 1;
}

const Step kSlip = step_of(load_step, 1.0, 0.8);
const Step kValve = step_of(valve_stiction, 0.5, 0.45);

TEST(PreferHysteresis, SlipsThatPassForJumpsAreTheValves) {
  EXPECT_TRUE(by_cycle(preferred("square_limit_cycle", {})));
  EXPECT_TRUE(by_cycle(preferred("square_limit_cycle", {kSlip, kSlip})));
  EXPECT_TRUE(by_cycle(preferred("square_limit_cycle", {kSlip, kSlip, kSlip, kValve})));
}

/// No one-step model has the valve, so that nothing can be asked with it in place.
TEST(PreferHysteresis, AValveOfTheCycleKeepsWhoAskedForIt) {
  const Explanation explanation = preferred("square_limit_cycle", {});
  ASSERT_TRUE(by_cycle(explanation));
  ASSERT_EQ(explanation.steps.front().asked_by.size(), 1U);
  EXPECT_EQ(explanation.steps.front().asked_by.front().test, "op_direction");
  EXPECT_FALSE(explanation.steps.front().asked_by.front().p_after);
  EXPECT_EQ(explanation.steps.front().promise_rank, 1U);
}

TEST(PreferHysteresis, AValveThatLeadsTheStoryStands) {
  EXPECT_FALSE(by_cycle(preferred("square_limit_cycle", {kValve})));
  EXPECT_FALSE(by_cycle(preferred("square_limit_cycle", {kSlip, kSlip, kValve})))
      << "fewer jumps than a story takes in";
  const Step most = step_of(valve_stiction, 1.0, 0.3);
  EXPECT_FALSE(by_cycle(preferred("square_limit_cycle", {kSlip, kSlip, kSlip, most})));
  EXPECT_FALSE(by_cycle(preferred("square_limit_cycle",
                                  {kSlip, kSlip, kSlip, kValve, step_of(sensor_hold, 0.4, 0.2)})));
}

TEST(PreferHysteresis, WhatDoesNotCycleAboutAValveKeepsItsSteps) {
  EXPECT_FALSE(by_cycle(preferred("outside_oscillation", {kSlip, kSlip, kSlip, kValve})));
}

}  // namespace
}  // namespace loopscope::core::model
