#include "core/model/selection/step_report.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>

#include "core/model/effects/curvature.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/effects/valve.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

/// The effect to start from; limits count from the mean of op.
using Start = std::function<EffectPtr(const LoopData&)>;

/// A model with one selected effect: that effect in the flow loop, noise and load as in the
/// scenarios.
StepwiseModel told(const simulate::Effect& truth, double move, const Start& start,
                   std::uint64_t seed) {
  simulate::LoopSettings loop = simulate::scenario_loop("healthy_flow");
  loop.effects = {truth};
  const double pattern[] = {1.0, -1.0, -1.0, 1.0};
  for (std::size_t i = 0; i < 40; ++i) {
    loop.setpoint_moves.push_back({.at_sample = 1000 + 103 * i, .size = move * pattern[i % 4]});
  }
  const simulate::LoopRecord record = simulate::simulate_loop(loop, seed);
  StepwiseModel stepwise{make_loop_data(record.pv, record.op, 1.0), {}, {}};
  Structure structure = tests::structure_of(tests::noiseless_process());
  structure.noise = {1, {0.98, 0.0, 0.0}, {-0.4, 0.0, 0.0}};
  stepwise.baseline = cross_fit(stepwise.data, evaluate(stepwise.data, structure));
  structure.effects = {start(stepwise.data)};
  const Fit fit = polish(
      stepwise.data, refine_last(stepwise.data, evaluate(stepwise.data, structure)).structure, 4);
  SelectedEffect entered;
  entered.fit = cross_fit(stepwise.data, fit);
  entered.comparison = compare(stepwise.data, stepwise.baseline, entered.fit);
  entered.rival_evidence = 12.0;
  entered.simulation_ratio = 0.5;
  stepwise.selected = {entered};
  return stepwise;
}

StepwiseModel saturated(std::uint64_t seed) {
  return told(
      simulate::ValveSaturation{.low_percent = 40.0, .high_percent = 53.0}, 6.0,
      [](const LoopData& data) { return std::make_shared<Saturation>(-1e9, 53.0 - data.op_mean); },
      seed);
}

TEST(StepReport, IsTheComparisonInPvUnits) {
  const StepwiseModel stepwise = saturated(1);
  const auto steps = report_steps(stepwise);
  ASSERT_EQ(steps.size(), 1U);
  const Comparison& comparison = stepwise.selected[0].comparison;
  const double square = stepwise.data.pv_scale * stepwise.data.pv_scale;
  EXPECT_EQ(steps[0].effect, EffectKind::valve_saturation);
  EXPECT_NEAR(steps[0].holdout_error_before, comparison.before * square, 1e-12);
  EXPECT_NEAR(steps[0].holdout_error_after, comparison.after * square, 1e-12);
  EXPECT_EQ(steps[0].evidence, comparison.evidence);
  EXPECT_EQ(steps[0].p, comparison.p);
  EXPECT_EQ(steps[0].margin, comparison.evidence - 12.0);
  EXPECT_EQ(steps[0].simulation_ratio, 0.5);
  EXPECT_FALSE(steps[0].statement.empty());
}

TEST(StepReport, AStoryWithoutChaptersHasNoSteps) {
  StepwiseModel stepwise = saturated(1);
  stepwise.selected.clear();
  EXPECT_TRUE(report_steps(stepwise).empty());
}

struct Coverage {
  int covered = 0, reported = 0;
};

void count(const StepwiseModel& stepwise, std::string_view parameter, double truth,
           Coverage& coverage) {
  for (const Step& step : report_steps(stepwise)) {
    for (const Parameter& found : step.parameters) {
      if (found.name != parameter) continue;
      // None where a quarter of the record takes the valve for play, which has other parameters.
      if (!found.low || !found.high) continue;
      EXPECT_LE(*found.low, found.value);
      EXPECT_GE(*found.high, found.value);
      ++coverage.reported;
      coverage.covered += *found.low <= truth && truth <= *found.high;
    }
  }
}

EffectPtr kano(const LoopData&) {
  return std::make_shared<ValveEffect>(Valve{ValveLaw::kano, 5.0, 2.0, 1.0});
}

Coverage coverage_of(std::string_view parameter, std::uint64_t seeds) {
  Coverage coverage;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    if (parameter == "high") count(saturated(seed), parameter, 53.0, coverage);
    if (parameter == "curvature") {
      count(told(
                simulate::ValveCharacteristic{.curvature = 0.4}, 15.0,
                [](const LoopData&) { return std::make_shared<ValveCharacteristic>(); }, seed),
            parameter, 0.4, coverage);
    }
    if (parameter == "S" || parameter == "J") {
      count(told(simulate::ValveStiction{.stickband_percent = 5.0,
                                         .slip_jump_percent = 2.0,
                                         .law = simulate::StictionLaw::kano},
                 0.0, kano, seed),
            parameter, parameter == "S" ? 5.0 : 2.0, coverage);
    }
  }
  std::printf("%s: %d of %d intervals cover the truth\n", std::string(parameter).c_str(),
              coverage.covered, coverage.reported);
  return coverage;
}

class StepIntervals : public testing::TestWithParam<const char*> {};

/// 90 % intervals: 78 % is three standard errors of 60 records below.
TEST_P(StepIntervals, CoverTheTruthInNineOfTen) {
  const Coverage coverage = coverage_of(GetParam(), 60);
  ASSERT_GE(coverage.reported, 50);
  EXPECT_GE(coverage.covered, 0.78 * coverage.reported);
}

INSTANTIATE_TEST_SUITE_P(Parameters, StepIntervals, testing::Values("high", "curvature", "S", "J"),
                         [](const auto& tested) { return std::string(tested.param); });

/// What sits at one place has no parts to be fitted again on.
TEST(StepReport, ALoadStepHasNoInterval) {
  const StepwiseModel stepwise = told(
      simulate::LoadStep{.at_s = 2000.0, .size = 8.0}, 0.0,
      [](const LoopData&) { return std::make_shared<LoadStep>(2000); }, 1);
  const std::vector<Step> steps = report_steps(stepwise);
  for (const Parameter& found : steps.front().parameters) {
    EXPECT_FALSE(found.low || found.high) << found.name;
  }
}

}  // namespace
}  // namespace loopscope::core::model
