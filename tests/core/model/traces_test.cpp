#include "core/model/traces.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/core/model/traced_loop.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using enum EffectKind;
using tests::Series;

using loopscope::tests::kNaN;

void expect_equal(const Step& one, const Step& other) {
  EXPECT_EQ(one.effect, other.effect);
  EXPECT_EQ(one.holdout_error_before, other.holdout_error_before);
  EXPECT_EQ(one.holdout_error_after, other.holdout_error_after);
  EXPECT_EQ(one.evidence, other.evidence);
  EXPECT_EQ(one.simulation_ratio, other.simulation_ratio);
  EXPECT_EQ(one.statement, other.statement);
  ASSERT_EQ(one.parameters.size(), other.parameters.size());
  for (std::size_t i = 0; i < one.parameters.size(); ++i) {
    EXPECT_EQ(one.parameters[i].value, other.parameters[i].value);
    EXPECT_EQ(one.parameters[i].low, other.parameters[i].low);
  }
}

void expect_equal(const Explanation& one, const Explanation& other) {
  EXPECT_EQ(one.excitation, other.excitation);
  EXPECT_EQ(one.error_kind, other.error_kind);
  EXPECT_EQ(one.baseline.description, other.baseline.description);
  EXPECT_EQ(one.baseline.holdout_error, other.baseline.holdout_error);
  EXPECT_EQ(one.baseline.process.gain, other.baseline.process.gain);
  EXPECT_EQ(one.unexplained.fraction, other.unexplained.fraction);
  EXPECT_EQ(one.unexplained.statement, other.unexplained.statement);
  if (one.error_kind == ErrorKind::one_step) {
    EXPECT_EQ(one.noise_floor, other.noise_floor);
  }
  ASSERT_EQ(one.steps.size(), other.steps.size());
  for (std::size_t i = 0; i < one.steps.size(); ++i) expect_equal(one.steps[i], other.steps[i]);
}

TEST(Traces, TheExplanationIsThatOfExplain) {
  for (const char* scenario : {"healthy_flow", "paper_5_4", "load_upsets", "holding_sensor",
                               "quantised_sensor", "process_gain_change"}) {
    SCOPED_TRACE(scenario);
    const tests::TracedLoop loop = tests::traced(scenario);
    const auto explanation = tests::explain_record(loop.record);
    ASSERT_TRUE(loop.traces && explanation);
    expect_equal(loop.traces->explanation, *explanation);
  }
}

TEST(Traces, NoExplanationNoTraces) {
  simulate::LoopRecord record = simulate::simulate_scenario("healthy_flow", {}, 1);
  record.op.assign(record.op.size(), 50.0);
  EXPECT_FALSE(tests::traced(record).traces);
  const Series pv(1000, 1.0), op(999, 1.0);
  EXPECT_THROW(std::ignore = trace_explanation({pv, op, {}, {}, 1.0}), std::invalid_argument);
}

TEST(Traces, WhatIsMissingIsMissing) {
  simulate::LoopRecord record = simulate::simulate_scenario("paper_5_4", {}, 1);
  for (std::size_t k = 1000; k < 1030; ++k) record.pv[k] = kNaN;
  for (std::size_t k = 2000; k < 2010; ++k) record.op[k] = kNaN;
  const tests::TracedLoop loop = tests::traced(std::move(record));
  tests::expect_sound(loop, "gaps");
  tests::expect_figures(*loop.traces, tests::kRounding, "gaps");
  for (const TraceStage& stage : loop.traces->stages) {
    EXPECT_TRUE(std::isnan(stage.one_step_prediction[1010]));
    EXPECT_TRUE(std::isnan(stage.one_step_residual[1010]));
    EXPECT_FALSE(stage.held_out[2005]);
    EXPECT_TRUE(std::isnan(stage.one_step_prediction[0]));
    EXPECT_FALSE(std::isnan(stage.simulated[1010])) << "op was known there";
  }
}

/// The rows on which the linear loop is scored are those of its simulation error.
TEST(Traces, TheValveShowsInTheSimulation) {
  const tests::TracedLoop loop = tests::traced("sticking_valve");
  ASSERT_TRUE(loop.traces);
  const TraceStage& linear = loop.traces->stages[0];
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < linear.held_out.size(); ++k) {
    if (!linear.held_out[k]) continue;
    sum += std::pow(loop.traces->measured[k] - linear.simulated[k], 2);
    count += 1.0;
  }
  EXPECT_NEAR(sum / count / linear.simulation_error, 1.0, tests::kRounding);
  const std::size_t at = tests::stage_of(*loop.traces, valve_stiction);
  ASSERT_EQ(at, 1U);
  EXPECT_LT(loop.traces->stages[1].simulation_error, 0.5 * linear.simulation_error);
}

/// The stretch shows more of the effect than the record does in the mean.
TEST(Traces, TheTellingStretchTells) {
  for (const char* scenario : {"paper_5_4", "load_upsets", "saturated_valve"}) {
    const tests::TracedLoop loop = tests::traced(scenario);
    ASSERT_TRUE(loop.traces) << scenario;
    const auto& stages = loop.traces->stages;
    ASSERT_GE(stages.size(), 2U) << scenario;
    double within = 0.0, all = 0.0;
    for (std::size_t k = 0; k < stages[0].held_out.size(); ++k) {
      const double before = stages[0].one_step_residual[k], after = stages[1].one_step_residual[k];
      if (std::isnan(before) || std::isnan(after)) continue;
      const double gain = before * before - after * after;
      all += gain;
      if (k >= loop.traces->telling_from &&
          k < loop.traces->telling_from + loop.traces->telling_samples)
        within += gain;
    }
    const double share = static_cast<double>(loop.traces->telling_samples) /
                         static_cast<double>(stages[0].held_out.size());
    EXPECT_GT(within, share * all) << scenario;
  }
}

}  // namespace
}  // namespace loopscope::core::model
