#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/model/traces.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/core/model/traced_loop.hpp"

/// What each kind of effect leaves in the series.
namespace loopscope::core::model {
namespace {

using enum EffectKind;

struct Put {
  const char* scenario;
  EffectKind effect;
};
void PrintTo(const Put& put, std::ostream* stream) {
  *stream << put.scenario;
}
class TracesOf : public testing::TestWithParam<Put> {};

/// Mean squares of two stages on the samples that count in both.
std::pair<double, double> compared(const TraceStage& before, const TraceStage& after) {
  double a = 0.0, b = 0.0;
  for (std::size_t k = 0; k < before.held_out.size(); ++k) {
    if (!before.held_out[k] || !after.held_out[k]) continue;
    a += before.one_step_residual[k] * before.one_step_residual[k];
    b += after.one_step_residual[k] * after.one_step_residual[k];
  }
  return {a, b};
}

TEST_P(TracesOf, TheResidualFallsAtItsEffect) {
  const tests::TracedLoop loop = tests::traced(GetParam().scenario);
  tests::expect_sound(loop, GetParam().scenario);
  const ExplanationTraces& traces = *loop.traces;
  tests::expect_figures(traces, tests::kRounding, GetParam().scenario);
  const std::size_t at = tests::stage_of(traces, GetParam().effect);
  ASSERT_GT(at, 0U);
  const auto [before, after] = compared(traces.stages[at - 1], traces.stages[at]);
  EXPECT_LT(after, 0.97 * before);
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, TracesOf,
    testing::Values(Put{"paper_5_4", valve_stiction}, Put{"sticking_valve", valve_stiction},
                    Put{"deadband", valve_deadband}, Put{"saturated_valve", valve_saturation},
                    Put{"worn_valve", valve_characteristic},
                    Put{"nonlinear_process", process_nonlinearity},
                    Put{"outside_oscillation", external_oscillation}, Put{"load_upsets", load_step},
                    Put{"process_gain_change", gain_change}),
    [](const auto& put) { return std::string(put.param.scenario); });

/// In between renewals pv is known, and the last hold may end with the record.
TEST(TracesOfEffects, OfAHeldSensorTheRenewalsArePredicted) {
  const tests::TracedLoop loop = tests::traced("holding_sensor");
  tests::expect_sound(loop, "holding_sensor");
  const ExplanationTraces& traces = *loop.traces;
  tests::expect_figures(traces, 0.01, "holding_sensor");
  const std::size_t at = tests::stage_of(traces, sensor_hold);
  ASSERT_GT(at, 0U);
  const TraceStage& held = traces.stages[at];
  EXPECT_LT(held.one_step_error, traces.stages[at - 1].one_step_error);
  const double hold = traces.explanation.steps[at - 1].parameters.front().value;
  const auto count = [&](bool (*counts)(double)) {
    return static_cast<double>(std::ranges::count_if(held.one_step_residual, counts));
  };
  const double known = count([](double residual) { return !std::isnan(residual); });
  const double renewals = count([](double residual) { return std::abs(residual) > 0.0; });
  EXPECT_NEAR(renewals * hold / known, 1.0, 0.01);
}

TEST(TracesOfEffects, AGridOfTheSensorChangesNothing) {
  const tests::TracedLoop loop = tests::traced("quantised_sensor");
  tests::expect_sound(loop, "quantised_sensor");
  const std::size_t at = tests::stage_of(*loop.traces, sensor_quantisation);
  ASSERT_EQ(at, 1U);
  const TraceStage &before = loop.traces->stages[0], &after = loop.traces->stages[1];
  EXPECT_EQ(before.one_step_error, after.one_step_error);
  EXPECT_EQ(before.held_out, after.held_out);
}

TEST(TracesOfEffects, ALoopWithoutEffectsHasTheLinearStageAlone) {
  for (const char* scenario : {"healthy_flow", "paper_5_1"}) {
    const tests::TracedLoop loop = tests::traced(scenario);
    tests::expect_sound(loop, scenario);
    ASSERT_EQ(loop.traces->stages.size(), 1U) << scenario;
    tests::expect_figures(*loop.traces, tests::kRounding, scenario);
    const double middle = static_cast<double>(loop.traces->telling_from) +
                          0.5 * static_cast<double>(loop.traces->telling_samples);
    EXPECT_NEAR(middle, 0.5 * static_cast<double>(loop.record.pv.size()), 1.0) << scenario;
  }
}

/// The one-step error shows nothing of that valve; the square wave that looks like one is the trap
/// of core/model/limit_cycle/MEASURED.md.
TEST(TracesOfEffects, AValveThatTheCycleNamesIsSimulated) {
  const auto families = loopscope::tests::model::field_families();
  const auto family =
      std::ranges::find(families, "square_flow", &loopscope::tests::model::FieldFamily::name);
  ASSERT_NE(family, families.end());
  const auto field = loopscope::tests::model::record_of(*family, 2);
  std::vector<double> error(field.pv.size());
  std::ranges::transform(field.sp, field.pv, error.begin(), std::minus<>());
  const auto traces = trace_explanation({field.pv, field.op, field.sp, error, 1.0, true, 1});
  ASSERT_TRUE(traces);
  ASSERT_EQ(traces->explanation.error_kind, ErrorKind::simulation);
  ASSERT_EQ(traces->stages.size(), 2U);
  const TraceStage &linear = traces->stages[0], &valve = traces->stages[1];
  EXPECT_NEAR(tests::mean_square(linear), linear.one_step_error, tests::kRounding);
  EXPECT_TRUE(valve.one_step_prediction.empty());
  EXPECT_TRUE(valve.one_step_residual.empty());
  EXPECT_TRUE(valve.held_out.empty());
  EXPECT_TRUE(std::isnan(valve.one_step_error));
  EXPECT_EQ(valve.simulated.size(), field.pv.size());
  EXPECT_LT(valve.simulation_error, 0.5 * linear.simulation_error);
  EXPECT_GE(traces->telling_samples, 200U);
}

}  // namespace
}  // namespace loopscope::core::model
