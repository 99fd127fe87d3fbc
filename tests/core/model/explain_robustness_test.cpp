#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "core/model/explain.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

/// Whatever was recorded, an explanation is a value: no exception, no NaN; in any unit the same.
namespace loopscope::core::model {
namespace {

using loopscope::tests::kNaN;

const char* const kScenarios[] = {"healthy_flow", "sticking_valve", "outside_oscillation",
                                  "load_upsets", "level_loop"};

void expect_numbers(const Step& step, const std::string& where) {
  for (const double value :
       {step.holdout_error_before, step.holdout_error_after, step.evidence, step.p, step.margin,
        step.steadiness, step.simulation_ratio.value_or(0.0)}) {
    EXPECT_FALSE(std::isnan(value)) << where;
  }
  for (const Parameter& parameter : step.parameters) {
    EXPECT_TRUE(std::isfinite(parameter.value)) << where << " " << parameter.name;
    EXPECT_TRUE(std::isfinite(parameter.low.value_or(0.0))) << where << " " << parameter.name;
    EXPECT_TRUE(std::isfinite(parameter.high.value_or(0.0))) << where << " " << parameter.name;
  }
}

void expect_numbers(const Explanation& explanation, const std::string& where) {
  const ProcessFit& process = explanation.baseline.process;
  for (const double value :
       {explanation.noise_floor, explanation.baseline.holdout_error, process.gain,
        process.time_constant_s, process.second_time_constant_s, process.delay_s,
        explanation.unexplained.fraction, explanation.unexplained.whiteness_p}) {
    EXPECT_TRUE(std::isfinite(value)) << where;
  }
  for (const Step& step : explanation.steps) expect_numbers(step, where);
  for (const Question& question : explanation.questions) {
    EXPECT_GE(question.p, 0.0) << where << " " << question.name;
    EXPECT_LE(question.p, 1.0) << where << " " << question.name;
  }
  if (explanation.closed_loop) {
    EXPECT_FALSE(std::isnan(explanation.closed_loop->peak_sensitivity)) << where;
    EXPECT_FALSE(std::isnan(explanation.closed_loop->damping)) << where;
  }
}

void expect_explained(const simulate::LoopRecord& record, const std::string& where) {
  const auto explanation = tests::explain_record(record);
  ASSERT_TRUE(explanation) << where;
  expect_numbers(*explanation, where);
}

TEST(ExplainRobustness, Gaps) {
  for (const char* scenario : kScenarios) {
    simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, 1);
    std::mt19937_64 engine(1);
    for (int gap = 0; gap < 30; ++gap) {
      const std::size_t from = engine() % 4000, length = 1 + engine() % 60;
      auto& series = gap % 2 == 0 ? record.pv : record.op;
      std::fill_n(series.begin() + static_cast<long>(from), std::min(length, 4096 - from), kNaN);
    }
    expect_explained(record, scenario);
  }
}

TEST(ExplainRobustness, MissingEnds) {
  for (const char* scenario : kScenarios) {
    simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, 1);
    std::fill_n(record.pv.begin(), 300, kNaN);
    std::fill_n(record.op.end() - 300, 300, kNaN);
    expect_explained(record, scenario);
  }
}

TEST(ExplainRobustness, EverySecondSampleMissing) {
  simulate::LoopRecord record = simulate::simulate_scenario("healthy_flow", {}, 1);
  for (std::size_t k = 0; k < record.pv.size(); k += 2) record.pv[k] = kNaN;
  // Rows need their predecessors: none is whole.
  EXPECT_FALSE(tests::explain_record(record));
}

TEST(ExplainRobustness, ShortRecords) {
  for (const char* scenario : kScenarios) {
    for (const std::size_t samples : {400U, 450U, 600U}) {
      expect_explained(simulate::simulate_scenario(scenario, {samples, {}, {}}, 1),
                       std::string(scenario) + " " + std::to_string(samples));
    }
  }
}

TEST(ExplainRobustness, HugeOutliers) {
  for (const char* scenario : kScenarios) {
    simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, 1);
    record.pv[500] = 1e9;
    record.pv[2500] = -1e12;
    record.op[1500] = 1e6;
    expect_explained(record, scenario);
  }
}

TEST(ExplainRobustness, AlmostConstantPv) {
  simulate::LoopRecord record = simulate::simulate_scenario("healthy_flow", {}, 1);
  std::fill(record.pv.begin(), record.pv.end(), 50.0);
  record.pv[2000] = 50.1;
  const auto explanation = tests::explain_record(record);
  ASSERT_TRUE(explanation);
  expect_numbers(*explanation, "one sample");
  EXPECT_FALSE(explanation->excited);
  EXPECT_TRUE(explanation->steps.empty());
}

TEST(ExplainRobustness, OpThatStepsOnceOrTwice) {
  simulate::LoopRecord record = simulate::simulate_scenario("healthy_flow", {}, 1);
  for (const std::size_t at : {100U, 2000U, 4000U}) {
    std::fill(record.op.begin(), record.op.end(), 50.0);
    std::fill(record.op.begin() + static_cast<long>(at), record.op.end(), 55.0);
    expect_explained(record, "one step at " + std::to_string(at));
  }
}

TEST(ExplainRobustness, PvWithoutNoise) {
  const tests::Series op = tests::stepping_op(4096, 1);
  const tests::Series pv =
      tests::process_record(tests::one_lag(0.8, 3), 1.2, op, tests::Series(4096, 0.0));
  const tests::Series sp(4096, 50.0), error = tests::sum(sp, tests::scaled(pv, -1.0));
  const auto explanation = explain({pv, op, sp, error, 1.0});
  ASSERT_TRUE(explanation);
  expect_numbers(*explanation, "no noise");
}

/// Effects, their order, and evidence: rounding moves the search by little.
void expect_same_explanation(const Explanation& one, const Explanation& other,
                             const std::string& where) {
  ASSERT_EQ(one.steps.size(), other.steps.size()) << where;
  for (std::size_t i = 0; i < one.steps.size(); ++i) {
    EXPECT_EQ(one.steps[i].effect, other.steps[i].effect) << where;
    EXPECT_NEAR(other.steps[i].evidence / one.steps[i].evidence, 1.0, 0.01) << where;
  }
}

TEST(ExplainRobustness, PvInAnyUnit) {
  for (const char* scenario : kScenarios) {
    const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, 1);
    const auto plain = tests::explain_record(record);
    ASSERT_TRUE(plain);
    // Powers of two leave every digit as it is, so nothing but the unit may change.
    for (const double unit : {std::exp2(-20.0), std::exp2(20.0)}) {
      simulate::LoopRecord other = record;
      other.pv = tests::scaled(record.pv, unit);
      other.sp = tests::scaled(record.sp, unit);
      const auto same = tests::explain_record(other);
      ASSERT_TRUE(same);
      const std::string where = std::string(scenario) + " times " + std::to_string(unit);
      expect_same_explanation(*plain, *same, where);
      EXPECT_NEAR(same->noise_floor / (unit * unit) / plain->noise_floor, 1.0, 0.01) << where;
      EXPECT_NEAR(same->baseline.holdout_error / (unit * unit) / plain->baseline.holdout_error, 1.0,
                  0.01)
          << where;
    }
  }
}

TEST(ExplainRobustness, PvOfAMillionthAndAMillion) {
  for (const double unit : {1e-6, 1e6}) {
    simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
    record.pv = tests::scaled(record.pv, unit);
    record.sp = tests::scaled(record.sp, unit);
    expect_explained(record, std::to_string(unit));
  }
}

/// No range is known: S and J are in op units then.
TEST(ExplainRobustness, OpInRawUnits) {
  for (const char* scenario : kScenarios) {
    const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, 2);
    const tests::Series error = simulate::control_error(record);
    const auto plain = tests::explain_record(record);
    const tests::Series raw = tests::scaled(record.op, std::exp2(13.0));
    const auto same =
        explain({record.pv, raw, record.sp, error, record.sample_interval_s, false, 1});
    ASSERT_TRUE(plain && same);
    expect_numbers(*same, scenario);
    ASSERT_EQ(plain->steps.empty(), same->steps.empty()) << scenario;
    if (!plain->steps.empty()) {
      EXPECT_EQ(plain->steps.front().effect, same->steps.front().effect) << scenario;
      EXPECT_NEAR(same->steps.front().evidence / plain->steps.front().evidence, 1.0, 0.05)
          << scenario;
    }
  }
}

}  // namespace
}  // namespace loopscope::core::model
