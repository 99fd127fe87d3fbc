#include "tests/effects/outcome.hpp"

#include <gtest/gtest.h>

namespace loopscope::tests::effects {
namespace {

using core::model::EffectKind;
using core::model::Explanation;
using core::model::Step;

Record sticking() {
  Record record;
  record.pv.assign(1000, 0.0);
  record.truth.kind = {
      "valve_stiction", Group::single, {"valve_stiction"}, {"valve_stiction"}, false};
  record.truth.effects = {{"valve_stiction", {{"S", "%", 4.0}, {"J", "%", 2.0}}, "he"}};
  record.truth.floor = 0.5;
  return record;
}

Step step_of(EffectKind effect, std::vector<core::model::Parameter> parameters) {
  Step step;
  step.effect = effect;
  step.parameters = std::move(parameters);
  step.holdout_error_before = 2.0;
  step.holdout_error_after = 0.75;
  return step;
}

TEST(Outcome, RightStepIsMeasuredAgainstTheTruth) {
  Explanation model;
  model.steps = {step_of(EffectKind::valve_stiction, {{"S", "%", 5.0, {}, {}}})};
  model.noise_floor = 0.6;
  const Outcome outcome = judge(sticking(), "valve_stiction", 0.9, &model);
  EXPECT_TRUE(outcome.verdict_right);
  EXPECT_TRUE(outcome.named_right);
  EXPECT_TRUE(outcome.all_found);
  EXPECT_FALSE(outcome.misleads);
  EXPECT_NEAR(outcome.parameter_errors.at("valve_stiction.S"), 0.25, 1e-12);
  EXPECT_NEAR(*outcome.error_before, 4.0, 1e-12);
  EXPECT_NEAR(*outcome.error_after, 1.5, 1e-12);
  EXPECT_NEAR(*outcome.model_floor, 1.2, 1e-12);
}

TEST(Outcome, WrongFirstStepIsNotRightThoughTheSecondIs) {
  Explanation model;
  model.steps = {step_of(EffectKind::load_step, {}), step_of(EffectKind::valve_stiction, {})};
  const Outcome outcome = judge(sticking(), "external_disturbance", 0.9, &model);
  EXPECT_FALSE(outcome.named_right);
  EXPECT_TRUE(outcome.all_found);
  EXPECT_TRUE(outcome.misleads);
}

TEST(Outcome, IgnoranceDoesNotMislead) {
  EXPECT_FALSE(judge(sticking(), "nonlinear_unexplained", 0.9, nullptr).misleads);
  EXPECT_FALSE(judge(sticking(), "healthy", 0.9, nullptr).misleads);
  EXPECT_FALSE(judge(sticking(), "healthy", 0.9, nullptr).modelled);
}

TEST(Outcome, HealthyLoopIsAccusedByVerdictOrStep) {
  Record healthy;
  healthy.truth.kind = {"healthy_still", Group::healthy, {}, {"healthy"}, true};
  healthy.truth.floor = 1.0;
  EXPECT_FALSE(judge(healthy, "external_disturbance", 0.5, nullptr).accuses_hardware);
  EXPECT_TRUE(judge(healthy, "process_change", 0.5, nullptr).accuses_hardware);
  Explanation model;
  EXPECT_TRUE(judge(healthy, "healthy", 0.5, &model).named_right);
  model.steps = {step_of(EffectKind::gain_change, {})};
  EXPECT_TRUE(judge(healthy, "healthy", 0.5, &model).accuses_hardware);
}

TEST(Outcome, StepsAreComparedWithTheNearestTrueOne) {
  Record record;
  record.pv.assign(1000, 0.0);
  record.truth.kind = {"load_step", Group::single, {"load_step"}, {"external_disturbance"}, true};
  record.truth.effects = {{"load_step", {{"at", "s", 200.0}, {"size", "pv", 1.0}}, ""},
                          {"load_step", {{"at", "s", 700.0}, {"size", "pv", -2.0}}, ""}};
  record.truth.floor = 1.0;
  Explanation model;
  model.steps = {
      step_of(EffectKind::load_step, {{"at", "s", 710.0, {}, {}}, {"size", "pv", -2.2, {}, {}}})};
  const Outcome outcome = judge(record, "external_disturbance", 0.5, &model);
  EXPECT_NEAR(outcome.parameter_errors.at("load_step.at"), 0.01, 1e-12);
  EXPECT_NEAR(outcome.parameter_errors.at("load_step.size"), 0.1, 1e-12);
}

}  // namespace
}  // namespace loopscope::tests::effects
