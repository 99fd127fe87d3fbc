#include "core/model/sensor_steps.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kSamples = 2000;

struct Looked {
  LoopData data;
  Fit fit;
};

/// pv renewed every `hold` samples.
Looked held_record(std::size_t hold) {
  const tests::Series op = tests::stepping_op(kSamples, 1);
  tests::Series pv =
      tests::process_record(tests::one_lag(0.8, 3), 1.5, op, tests::white_noise(kSamples, 2));
  for (std::size_t k = 0; k < kSamples; ++k) pv[k] = pv[k - k % hold];
  Looked result{make_loop_data(pv, op, 1.0), {}};
  result.fit = evaluate(result.data, tests::structure_of(tests::one_lag(0.8, 3)));
  return result;
}

std::vector<Answer> answer_with(const Nomination& nomination) {
  Answer answer;
  answer.question = {"any", nomination.p, {}};
  answer.nominations = {nomination};
  return {answer};
}

Nomination grid(double p) {
  return {.effect = EffectKind::sensor_quantisation, .p = p, .step = 0.5};
}

Nomination held(double p) {
  return {.effect = EffectKind::sensor_hold, .p = p, .hold_samples = 4.0};
}

TEST(SensorSteps, NothingNominatedNothingFound) {
  const Looked looked = held_record(1);
  const SensorFinding finding = find_sensor_steps(looked.data, looked.fit, {});
  EXPECT_TRUE(finding.steps.empty());
  EXPECT_FALSE(finding.rows.has_value());
}

TEST(SensorSteps, OnlyWhatIsClearIsFound) {
  const Looked looked = held_record(4);
  EXPECT_TRUE(find_sensor_steps(looked.data, looked.fit, answer_with(grid(1e-3))).steps.empty());
  EXPECT_TRUE(find_sensor_steps(looked.data, looked.fit, answer_with(held(1e-3))).steps.empty());
}

TEST(SensorSteps, AGridIsAStepOfItsSize) {
  const Looked looked = held_record(1);
  const SensorFinding finding = find_sensor_steps(looked.data, looked.fit, answer_with(grid(1e-9)));
  ASSERT_EQ(finding.steps.size(), 1U);
  const Step& step = finding.steps.front();
  EXPECT_EQ(step.effect, EffectKind::sensor_quantisation);
  EXPECT_EQ(tests::value_of(step.parameters, "step"), 0.5);
  EXPECT_EQ(step.p, 1e-9);
  EXPECT_GT(step.evidence, 0.0);
  EXPECT_FALSE(step.statement.empty());
  EXPECT_FALSE(finding.rows.has_value());
}

TEST(SensorSteps, OfAHeldSensorTheRenewedRowsAreLeft) {
  const Looked looked = held_record(4);
  const SensorFinding finding = find_sensor_steps(looked.data, looked.fit, answer_with(held(1e-9)));
  ASSERT_EQ(finding.steps.size(), 1U);
  EXPECT_EQ(tests::value_of(finding.steps.front().parameters, "samples"), 4.0);
  ASSERT_TRUE(finding.rows.has_value());
  for (const auto* rows : {&finding.rows->fit, &finding.rows->score}) {
    for (const Range& range : *rows) {
      for (std::size_t k = range.first; k < range.end; ++k) EXPECT_EQ(k % 4, 0U);
    }
  }
  const double share = static_cast<double>(finding.rows->fit_count()) /
                       static_cast<double>(looked.data.rows.fit_count());
  EXPECT_NEAR(share, 0.25, 0.03);
  // Between renewals the last value predicts without error.
  EXPECT_LT(finding.steps.front().holdout_error_after, finding.steps.front().holdout_error_before);
}

TEST(SensorSteps, TooFewRenewalsAreNotJudged) {
  const Looked looked = held_record(100);
  EXPECT_FALSE(
      find_sensor_steps(looked.data, looked.fit, answer_with(held(1e-9))).rows.has_value());
}

}  // namespace
}  // namespace loopscope::core::model
