#include <gtest/gtest.h>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core {
namespace {

FirstLook look_at_scenario(const char* scenario) {
  const auto record = simulate::simulate_scenario(scenario, {}, 1);
  signal::LoopWindow window;
  window.sample_interval_s = record.sample_interval_s;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  return first_look(window, {});
}

/// A cause that no statistics give.
ModelPlan never() {
  return {.cause = ModelTrigger{.largest_p = -1.0, .least_confidence = 2.0},
          .traces = false,
          .done = {}};
}

TEST(ModelPlan, EveryStageIsTold) {
  const FirstLook first = look_at_scenario("sticking_valve");
  std::vector<Stage> stages;
  ModelPlan plan;
  plan.done = [&](Stage stage) { stages.push_back(stage); };
  EXPECT_TRUE(diagnose(first, {}, {}, nullptr, plan).evidence.model);
  EXPECT_EQ(stages, (std::vector{Stage::statistics, Stage::model, Stage::verdict}));
}

TEST(ModelPlan, WithoutACauseThereIsNoModelAndNoStageOfOne) {
  const FirstLook first = look_at_scenario("sticking_valve");
  std::vector<Stage> stages;
  ModelPlan plan = never();
  plan.done = [&](Stage stage) { stages.push_back(stage); };
  EXPECT_FALSE(diagnose(first, {}, {}, nullptr, plan).evidence.model);
  EXPECT_EQ(stages, (std::vector{Stage::statistics, Stage::verdict}));
}

TEST(ModelPlan, TracesComeWithTheSameVerdict) {
  const FirstLook first = look_at_scenario("sticking_valve");
  const Diagnosis plain = diagnose(first, {});
  const Diagnosis traced =
      diagnose(first, {}, {}, nullptr, {.cause = {}, .traces = true, .done = {}});
  EXPECT_FALSE(plain.traces);
  ASSERT_TRUE(traced.traces);
  EXPECT_EQ(traced.verdict.code, plain.verdict.code);
  EXPECT_EQ(traced.verdict.confidence, plain.verdict.confidence);
}

}  // namespace
}  // namespace loopscope::core
