#include "core/model/explain.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

#include "core/model/controller/closed_loop.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/known_loops.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kNaN;

TEST(Explain, NothingToFitIsNoExplanation) {
  const simulate::LoopRecord record = tests::scenario_record("healthy_flow");
  simulate::LoopRecord changed = record;
  changed.op.clear();
  EXPECT_FALSE(tests::explain_record(changed));
  changed = record;
  changed.op.assign(record.op.size(), 50.0);
  EXPECT_FALSE(tests::explain_record(changed));
  changed = record;
  changed.pv.assign(record.pv.size(), 50.0);
  EXPECT_FALSE(tests::explain_record(changed));
  changed = record;
  changed.pv.assign(record.pv.size(), kNaN);
  EXPECT_FALSE(tests::explain_record(changed));
}

/// 400 samples on which both are known, wherever the others are.
TEST(Explain, FewerThanFourHundredSamplesAreNotFitted) {
  simulate::LoopRecord record = tests::scenario_record("healthy_flow");
  for (std::size_t k = 0; k < 2000; ++k) record.pv[k] = kNaN;
  for (std::size_t k = 2399; k < 4096; ++k) record.op[k] = kNaN;
  EXPECT_FALSE(tests::explain_record(record));
  const simulate::LoopRecord again = tests::scenario_record("healthy_flow");
  record.op[2399] = again.op[2399];
  EXPECT_TRUE(tests::explain_record(record));
}

TEST(Explain, UnequalLengthsThrow) {
  const simulate::LoopRecord record = tests::scenario_record("healthy_flow");
  const tests::Series error = simulate::control_error(record);
  const std::span<const double> pv(record.pv), op(record.op), sp(record.sp), e(error);
  EXPECT_THROW(std::ignore = explain({pv, op.first(4000), sp, e, 1.0}), std::invalid_argument);
  EXPECT_THROW(std::ignore = explain({pv, op, sp.first(4000), e, 1.0}), std::invalid_argument);
  EXPECT_THROW(std::ignore = explain({pv, op, sp, e.first(4000), 1.0}), std::invalid_argument);
}

TEST(Explain, SetpointAndErrorNeedNotBeRecorded) {
  const simulate::LoopRecord record = tests::scenario_record("sticking_valve");
  const auto explanation = explain({record.pv, record.op, {}, {}, 1.0});
  ASSERT_TRUE(explanation);
  EXPECT_FALSE(explanation->closed_loop);
  ASSERT_FALSE(explanation->steps.empty());
}

TEST(Explain, EqualInputEqualExplanation) {
  for (const char* scenario : {"sticking_valve", "outside_oscillation", "healthy_flow"}) {
    const auto one = tests::explain_scenario(scenario, 3),
               other = tests::explain_scenario(scenario, 3);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->baseline.description, other->baseline.description);
    EXPECT_EQ(one->noise_floor, other->noise_floor);
    ASSERT_EQ(one->steps.size(), other->steps.size());
    for (std::size_t i = 0; i < one->steps.size(); ++i) {
      EXPECT_EQ(one->steps[i].evidence, other->steps[i].evidence);
      EXPECT_EQ(one->steps[i].statement, other->steps[i].statement);
    }
  }
}

void expect_consistent(const Explanation& explanation, const std::string& where) {
  EXPECT_GE(explanation.unexplained.fraction, 0.0) << where;
  EXPECT_LE(explanation.unexplained.fraction, 1.0) << where;
  EXPECT_GT(explanation.noise_floor, 0.0) << where;
  EXPECT_GE(explanation.baseline.process.delay_s, 1.0) << where;
  EXPECT_FALSE(explanation.excitation.empty()) << where;
  EXPECT_FALSE(explanation.questions.empty()) << where;
  double error = std::numeric_limits<double>::infinity();
  for (const Step& step : explanation.steps) {
    EXPECT_GE(step.p, 0.0) << where;
    EXPECT_LE(step.p, 1e-3) << where;
    EXPECT_GT(step.evidence, 0.0) << where;
    EXPECT_LE(step.margin, step.evidence) << where;
    EXPECT_GE(step.steadiness, 0.0) << where;
    EXPECT_LE(step.steadiness, 1.0) << where;
    EXPECT_LE(step.holdout_error_after, step.holdout_error_before) << where;
    EXPECT_FALSE(step.statement.empty()) << where;
    EXPECT_FALSE(step.parameters.empty()) << where;
    error = step.holdout_error_after;
  }
  if (!explanation.steps.empty()) {
    EXPECT_GE(error, 0.9 * explanation.noise_floor) << where;
  }
}

TEST(Explain, EveryExplanationIsConsistent) {
  for (const simulate::Scenario& scenario : simulate::all_scenarios()) {
    if (!scenario.is_loop) continue;
    const auto explanation = tests::explain_scenario(scenario.name, 11);
    ASSERT_TRUE(explanation) << scenario.name;
    expect_consistent(*explanation, std::string(scenario.name));
  }
}

/// The paper's valves have S = 3, J = 1; a chain of steps lowers the error from one to the next.
TEST(Explain, EveryStepStartsWhereTheLastOneEnded) {
  const auto explanation = tests::explain_scenario("load_upsets", 2);
  ASSERT_TRUE(explanation);
  ASSERT_GE(explanation->steps.size(), 2U);
  EXPECT_LT(explanation->steps.back().holdout_error_after,
            0.5 * explanation->steps.front().holdout_error_before);
}

/// On each record gain, time constant and delay of a well-excited loop.
TEST(Explain, FindsTheProcessOfALoopWhoseSetpointMoves) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    simulate::LoopSettings loop = simulate::scenario_loop("healthy_flow");
    for (std::size_t i = 0; i < 40; ++i) {
      loop.setpoint_moves.push_back({.at_sample = 1000 + 103 * i, .size = i % 2 == 0 ? 8.0 : -8.0});
    }
    const auto explanation = tests::explain_record(simulate::simulate_loop(loop, seed));
    ASSERT_TRUE(explanation);
    EXPECT_TRUE(explanation->excited);
    EXPECT_TRUE(explanation->process_doubt.empty()) << explanation->process_doubt;
    EXPECT_TRUE(explanation->steps.empty()) << explanation->steps.front().statement;
    EXPECT_NEAR(explanation->baseline.process.gain, 1.2, 0.06) << seed;
    EXPECT_NEAR(explanation->baseline.process.time_constant_s, -1.0 / std::log(0.6), 0.3) << seed;
    EXPECT_EQ(explanation->baseline.process.delay_s, 2.0) << seed;
    ASSERT_TRUE(explanation->closed_loop);
    EXPECT_NEAR(explanation->closed_loop->controller_gain, 0.27, 0.01) << seed;
  }
}

TEST(Explain, LoopsWithoutDelayInTheirUnitsAreInSeconds) {
  const simulate::LoopRecord slow =
      simulate::simulate_scenario("sticking_valve", {4096, 10.0, {}}, 4);
  const simulate::LoopRecord fast =
      simulate::simulate_scenario("sticking_valve", {4096, 1.0, {}}, 4);
  const auto one = tests::explain_record(slow), other = tests::explain_record(fast);
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(one->baseline.process.delay_s, 10.0 * other->baseline.process.delay_s, 1e-9);
  EXPECT_NEAR(one->baseline.process.time_constant_s, 10.0 * other->baseline.process.time_constant_s,
              1e-6);
  EXPECT_NEAR(one->baseline.holdout_error, other->baseline.holdout_error, 1e-9);
}

/// The paper's process has a zero; without it the loop of 5.2 would be unstable, with period 16.
TEST(Explain, TheClosedLoopOfThePapersProcessOscillatesAsItDoes) {
  const ClosedLoop truth = close_loop(known::paper_process(), known::law(0.15, 0.375), 1.0);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto explanation = tests::explain_scenario("paper_5_2_excessive", seed);
    ASSERT_TRUE(explanation && explanation->closed_loop) << seed;
    EXPECT_NEAR(explanation->closed_loop->period_s, truth.period_s, 1.0) << seed;
    EXPECT_NEAR(explanation->closed_loop->damping, truth.damping, 0.05) << seed;
  }
}

TEST(Explain, AHeldSensorHidesNoneOfTheProcess) {
  const tests::Series op = tests::stepping_op(4096, 1);
  const tests::Series pv = tests::held(
      tests::process_record(tests::one_lag(0.8, 5), 1.5, op, tests::white_noise(4096, 2, 0.3)), 12);
  const auto explanation = explain({pv, op, {}, {}, 2.0});
  ASSERT_TRUE(explanation && explanation->steps.size() == 1);
  EXPECT_EQ(explanation->steps.front().effect, EffectKind::sensor_hold);
  const ProcessFit& process = explanation->baseline.process;
  EXPECT_NEAR(process.gain, 1.5, 0.1);
  EXPECT_NEAR(process.delay_s, 10.0, 2.0);
  EXPECT_NEAR(process.time_constant_s, -2.0 / std::log(0.8), 2.0);
}

TEST(Explain, OfTooFewRenewalsNothingIsToldButTheHold) {
  simulate::LoopRecord record = tests::scenario_record("load_upsets");
  record.pv = tests::held(record.pv, 60);
  const auto explanation = tests::explain_record(record);
  ASSERT_TRUE(explanation);
  ASSERT_EQ(explanation->steps.size(), 1U);
  EXPECT_EQ(explanation->steps.front().effect, EffectKind::sensor_hold);
}

}  // namespace
}  // namespace loopscope::core::model
