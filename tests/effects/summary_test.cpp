#include "tests/effects/summary.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace loopscope::tests::effects {
namespace {

Outcome outcome(bool right, double confidence) {
  Outcome one;
  one.verdict = right ? "healthy" : "valve_stiction";
  one.verdict_right = right;
  one.accuses_hardware = one.misleads = !right;
  one.confidence = confidence;
  return one;
}

TEST(EffectsSummary, CountsRightFalseAndOverconfident) {
  const Plan plan{.kinds = {"healthy_still", "nonlinear_neighbour"}, .draws = 2};
  const Summary summary = summarise(
      plan, {{outcome(true, 0.8), outcome(false, 0.5)}, {outcome(true, 0.2), outcome(false, 0.7)}});
  EXPECT_NEAR(*summary.accuracy, 0.5, 1e-12);
  EXPECT_NEAR(*summary.false_on_healthy, 0.5, 1e-12);
  EXPECT_NEAR(*summary.overconfident_unknown, 0.5, 1e-12);
  EXPECT_NEAR(*summary.confident_right, 1.0, 1e-12);
  EXPECT_NEAR(*summary.brier, (0.04 + 0.25 + 0.64 + 0.49) / 4.0, 1e-12);
  EXPECT_FALSE(summary.both_found);
}

TEST(EffectsSummary, MediansAreByTheFloor) {
  Outcome one = outcome(true, 0.9);
  one.modelled = one.named_right = true;
  one.explainable = 1.8;
  one.error_before = 3.0;
  one.error_after = 1.5;
  one.parameter_errors = {{"valve_stiction.S", 0.1}};
  const Summary summary = summarise({.kinds = {"valve_stiction"}, .draws = 1}, {{one}});
  EXPECT_NEAR(*summary.kinds[0].explained, 0.75, 1e-12);
  EXPECT_NEAR(*summary.kinds[0].explainable, 1.8, 1e-12);
  EXPECT_NEAR(*summary.kinds[0].parameter_error, 0.1, 1e-12);
  EXPECT_NEAR(*summary.named_accuracy, 1.0, 1e-12);
}

TEST(EffectsSummary, JsonHasTheKeysOfTheContract) {
  const Summary summary =
      summarise({.kinds = {"healthy_still"}, .draws = 1}, {{outcome(true, 0.8)}});
  const auto json = nlohmann::json::parse(json_of(summary));
  for (const char* key : {"accuracy", "false_on_healthy", "overconfident_unknown"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"draws", "named_right", "parameter_error", "explainable", "error_before",
                          "error_after", "floor"})
    EXPECT_TRUE(json["kinds"]["healthy_still"].contains(key)) << key;
}

}  // namespace
}  // namespace loopscope::tests::effects
