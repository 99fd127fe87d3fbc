#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core {
namespace {

signal::LoopWindow window() {
  signal::LoopWindow window;
  for (int k = 0; k < 1000; ++k) {
    window.pv.push_back(std::sin(std::fmod(k * k, 17.0)));
    window.op.push_back(50.0 + std::sin(std::fmod(k * k, 13.0)));
  }
  window.sp.assign(1000, 0.0);
  return window;
}

TEST(LoopModel, TheSwitchLeavesItOut) {
  AnalysisSettings settings;
  settings.fit_model = false;
  EXPECT_FALSE(diagnose(window(), settings).evidence.model.has_value());
}

/// A slow loop waits for its turn (`model_every_slots`): only the controller's law tells it.
TEST(LoopModel, CauseIsWhateverTheStatisticsCallUnhealthy) {
  const auto cause = [](std::string_view scenario) {
    const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, 3);
    signal::LoopWindow loop;
    loop.sp = record.sp;
    loop.pv = record.pv;
    loop.op = record.op;
    loop.op_range = signal::OpRange{0.0, 100.0};
    const Evidence evidence = gather_evidence(first_look(loop, {}), {}, {});
    return triggers_model(evidence, {});
  };
  EXPECT_FALSE(cause("healthy_flow"));
  EXPECT_FALSE(cause("paper_5_1"));
  EXPECT_TRUE(cause("sticking_valve"));
  EXPECT_TRUE(cause("outside_oscillation"));
}

TEST(LoopModel, ACauseIsAVerdictThatIsSureEnough) {
  using enum diagnosis::VerdictCode;
  const ModelTrigger cause{0.005, 0.3};
  EXPECT_TRUE(cause.given_by(nonlinear_unexplained, 0.5, 0.001));
  EXPECT_FALSE(cause.given_by(nonlinear_unexplained, 0.5, 0.02));
  EXPECT_FALSE(cause.given_by(nonlinear_unexplained, 0.2, 0.001));
  EXPECT_TRUE(cause.given_by(valve_saturation, 0.5, std::nullopt)) << "a fact needs no test";
  EXPECT_FALSE(cause.given_by(healthy, 0.6, std::nullopt));
  EXPECT_FALSE(cause.given_by(insufficient_data, 1.0, std::nullopt));
}

TEST(LoopModel, NoModelOfDataThatCannotBeJudged) {
  signal::LoopWindow constant = window();
  constant.pv.assign(1000, 1.0);
  EXPECT_FALSE(diagnose(constant, {}).evidence.model.has_value());
}

/// Pictures are drawn of the very loop that was judged.
TEST(LoopModel, TracesAreOfTheSameExplanation) {
  const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 3);
  signal::LoopWindow loop;
  loop.sp = record.sp;
  loop.pv = record.pv;
  loop.op = record.op;
  loop.op_range = signal::OpRange{0.0, 100.0};
  const FirstLook first = first_look(loop, {});
  const auto explanation = explain_loop(first, {});
  const auto traces = trace_loop(first, {});
  ASSERT_TRUE(explanation && traces);
  EXPECT_EQ(traces->measured.size(), first.loop.pv.size());
  ASSERT_EQ(traces->explanation.steps.size(), explanation->steps.size());
  ASSERT_FALSE(explanation->steps.empty());
  EXPECT_EQ(traces->explanation.steps[0].evidence, explanation->steps[0].evidence);
}

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
