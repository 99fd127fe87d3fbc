#include "core/model/residual_tests/sensor_steps.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::model {
namespace {

constexpr double kError = 0.25;

TestOutcome held_every(double samples, double p) {
  TestOutcome answer;
  answer.question = {"held", p, ""};
  answer.nominations = {{.effect = EffectKind::sensor_hold, .p = p, .hold_samples = samples}};
  return answer;
}

TestOutcome grid_of(double step, double p) {
  TestOutcome answer;
  answer.question = {"grid", p, ""};
  answer.nominations = {{.effect = EffectKind::sensor_quantisation, .p = p, .step = step}};
  return answer;
}

TEST(SensorSteps, NothingWithoutClearAnswers) {
  const SensorFinding finding =
      find_sensor_steps(kError, {held_every(12.0, 1e-3), grid_of(1.0, 0.04)});
  EXPECT_FALSE(finding.hold);
  EXPECT_FALSE(finding.quantisation);
  EXPECT_EQ(finding.hold_samples, 1U);
}

TEST(SensorSteps, AClockIsAHold) {
  const SensorFinding finding = find_sensor_steps(kError, {held_every(12.0, 1e-40)});
  ASSERT_TRUE(finding.hold);
  EXPECT_EQ(finding.hold_samples, 12U);
  EXPECT_EQ(finding.hold->effect, EffectKind::sensor_hold);
  EXPECT_EQ(finding.hold->parameters.at(0).name, "samples");
  EXPECT_EQ(finding.hold->parameters.at(0).value, 12.0);
  EXPECT_EQ(finding.hold->holdout_error_before, kError);
  EXPECT_EQ(finding.hold->statement, "pv is renewed only every 12 samples.");
}

TEST(SensorSteps, AGridIsAStepThatLowersNothing) {
  const SensorFinding finding = find_sensor_steps(kError, {grid_of(0.5, 0.0)});
  ASSERT_TRUE(finding.quantisation);
  EXPECT_EQ(finding.quantisation->statement,
            "The values of pv lie on a grid of 0.5 units of pv, coarse beside their fast noise.");
  EXPECT_EQ(finding.quantisation->parameters.at(0).value, 0.5);
  EXPECT_EQ(finding.quantisation->holdout_error_after, finding.quantisation->holdout_error_before);
  EXPECT_GT(finding.quantisation->evidence, 1000.0);  // finite for a p of nothing
}

/// One long standstill leaves the rest of the record as it is.
TEST(SensorSteps, AFreezeIsAHoldThatIsNotRenewed) {
  TestOutcome freeze = held_every(200.0, 1e-40);
  freeze.nominations.front().at_sample = 1000;
  const SensorFinding finding = find_sensor_steps(kError, {freeze});
  ASSERT_TRUE(finding.hold);
  EXPECT_EQ(finding.hold->parameters.at(0).value, 200.0);
  EXPECT_FALSE(finding.renewed());
  EXPECT_TRUE(find_sensor_steps(kError, {held_every(12.0, 1e-40)}).renewed());
}

}  // namespace
}  // namespace loopscope::core::model
