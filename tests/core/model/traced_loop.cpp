#include "tests/core/model/traced_loop.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model::tests {

TracedLoop traced(simulate::LoopRecord record) {
  const Series error = simulate::control_error(record);
  auto traces = trace_explanation(
      {record.pv, record.op, record.sp, error, record.sample_interval_s, true, 1});
  return {std::move(record), std::move(traces)};
}

TracedLoop traced(std::string_view scenario, std::uint64_t seed) {
  return traced(simulate::simulate_scenario(scenario, {}, seed));
}

std::size_t stage_of(const ExplanationTraces& traces, EffectKind effect) {
  const auto at = std::ranges::find(traces.stages, std::optional(effect), &TraceStage::effect);
  return at == traces.stages.end() ? 0 : static_cast<std::size_t>(at - traces.stages.begin());
}

double mean_square(const TraceStage& stage) {
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < stage.held_out.size(); ++k) {
    if (!stage.held_out[k]) continue;
    sum += stage.one_step_residual[k] * stage.one_step_residual[k];
    count += 1.0;
  }
  return sum / count;
}

void expect_sound(const TracedLoop& loop, const std::string& where) {
  SCOPED_TRACE(where);
  ASSERT_TRUE(loop.traces);
  const ExplanationTraces& traces = *loop.traces;
  const std::size_t samples = loop.record.pv.size();
  ASSERT_EQ(traces.measured.size(), samples);
  ASSERT_EQ(traces.stages.size(), 1 + traces.explanation.steps.size());
  EXPECT_FALSE(traces.stages[0].effect);
  EXPECT_GE(traces.telling_samples, 200U);
  EXPECT_LE(traces.telling_from + traces.telling_samples, samples);
  for (std::size_t i = 0; i < traces.stages.size(); ++i) {
    const TraceStage& stage = traces.stages[i];
    if (i > 0) {
      EXPECT_EQ(stage.effect, traces.explanation.steps[i - 1].effect);
    }
    EXPECT_TRUE(stage.simulated.size() == samples);
    ASSERT_EQ(stage.one_step_prediction.size(), stage.one_step_residual.size());
    ASSERT_EQ(stage.held_out.size(), stage.one_step_residual.size());
    for (std::size_t k = 0; k < stage.held_out.size(); ++k) {
      const double residual = stage.one_step_residual[k];
      ASSERT_FALSE(stage.held_out[k] && std::isnan(residual)) << k;
      if (std::isnan(traces.measured[k])) {
        ASSERT_TRUE(std::isnan(stage.one_step_prediction[k])) << k;
      } else if (!std::isnan(residual)) {
        ASSERT_NEAR(traces.measured[k] - stage.one_step_prediction[k], residual, kRounding) << k;
      }
    }
  }
}

void expect_figures(const ExplanationTraces& traces, double tolerance, const std::string& where) {
  SCOPED_TRACE(where);
  const Explanation& explanation = traces.explanation;
  ASSERT_EQ(explanation.error_kind, ErrorKind::one_step);
  const auto near = [&](const TraceStage& stage, double figure) {
    EXPECT_NEAR(mean_square(stage) / figure, 1.0, tolerance);
    EXPECT_NEAR(stage.one_step_error / figure, 1.0, tolerance);
  };
  near(traces.stages[0], explanation.baseline.holdout_error);
  for (std::size_t i = 0; i < explanation.steps.size(); ++i)
    near(traces.stages[i + 1], explanation.steps[i].holdout_error_after);
}

}  // namespace loopscope::core::model::tests
