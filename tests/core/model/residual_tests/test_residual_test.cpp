#include "core/model/residual_tests/test_residual.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/simulate/scenario.hpp"
#include "tests/core/model/residual_tests/loops.hpp"
#include "tests/core/model/residual_tests/pass_rates.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::model {
namespace {

using tests::Questionable;
using tests::Series;
using tests::White;

using tests::kWhites;
using tests::powers;
using tests::sizes;

TEST(QuestionResidual, WhiteResidualsPass) {
  const auto records = static_cast<double>(loopscope::tests::records(200));
  // Four standard deviations of a true rate of 5 %, and of one of 1 %.
  const double most_5 = records * 0.05 + 4.0 * std::sqrt(records * 0.05 * 0.95);
  const double most_1 = records * 0.01 + 4.0 * std::sqrt(records * 0.01 * 0.99);
  for (const White kind : kWhites) {
    for (const auto& [question, counts] : sizes(kind, 750, static_cast<std::size_t>(records))) {
      // A variance that changes is there to be found.
      if (kind == White::modulated && question == "time_spread") continue;
      EXPECT_LE(counts.passed[0], most_5) << question << ", " << tests::name(kind);
      EXPECT_LE(counts.passed[1], most_1) << question << ", " << tests::name(kind);
    }
  }
}

TEST(QuestionResidual, EachEffectIsNominatedByItsQuestion) {
  struct Case {
    const char* scenario;
    const char* question;
    EffectKind effect;
  };
  using enum EffectKind;
  for (const Case& c : {Case{"paper_5_4", "op_direction", valve_stiction},
                        Case{"paper_5_4_kano", "op_direction", valve_stiction},
                        Case{"sticking_valve", "op_direction", valve_stiction},
                        Case{"sticking_level", "op_direction", valve_stiction},
                        Case{"deadband", "op_direction", valve_deadband},
                        Case{"saturated_valve", "op_level", valve_saturation},
                        Case{"worn_valve", "op_level", valve_characteristic},
                        Case{"nonlinear_process", "response_level", process_nonlinearity},
                        Case{"process_gain_change", "time_gain", gain_change},
                        Case{"load_upsets", "time_event", load_step},
                        Case{"outside_oscillation", "periodic", external_oscillation},
                        Case{"paper_5_3", "periodic", external_oscillation},
                        Case{"quantised_sensor", "grid", sensor_quantisation},
                        Case{"holding_sensor", "held", sensor_hold}}) {
    int nominated = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto record = simulate::simulate_scenario(c.scenario, {}, seed);
      const auto answers = test_residual(tests::arx_residual(record).view());
      const Nomination* nomination = tests::nomination_of(answers, c.question, c.effect);
      nominated += nomination != nullptr && tests::p_of(answers, c.question) <= 0.01 ? 1 : 0;
    }
    EXPECT_EQ(nominated, 5) << c.scenario;
  }
}

TEST(QuestionResidual, TheFiguresOfTheFaultsAreRight) {
  const auto oscillating = simulate::simulate_scenario("paper_5_3", {}, 1);
  const auto quantised = simulate::simulate_scenario("quantised_sensor", {}, 1);
  const auto holding = simulate::simulate_scenario("holding_sensor", {}, 1);
  const auto changed = simulate::simulate_scenario("process_gain_change", {}, 1);
  const auto nominated = [](const simulate::LoopRecord& record, const char* question,
                            EffectKind effect) {
    const auto answers = test_residual(tests::arx_residual(record).view());
    const Nomination* found = tests::nomination_of(answers, question, effect);
    return found == nullptr ? Nomination{} : *found;
  };
  using enum EffectKind;
  EXPECT_NEAR(nominated(oscillating, "periodic", external_oscillation).period_samples.value_or(0.0),
              100.0, 0.3);
  EXPECT_NEAR(nominated(quantised, "grid", sensor_quantisation).step.value_or(0.0), 1.0, 1e-9);
  EXPECT_EQ(nominated(holding, "held", sensor_hold).hold_samples, 12.0);
  EXPECT_NEAR(
      static_cast<double>(nominated(changed, "time_gain", gain_change).at_sample.value_or(0)),
      2048.0, 150.0);
}

TEST(QuestionResidual, HealthyLoopsNominateLittle) {
  int passed = 0;
  int asked = 0;
  for (const char* scenario : {"healthy_flow", "paper_5_1", "level_loop"})
    for (const auto& [question, counts] : powers(scenario, 10)) {
      passed += counts.passed[1];
      asked += counts.asked;
    }
  EXPECT_LE(passed, asked * 0.01 + 4.0 * std::sqrt(asked * 0.01));
}

TEST(QuestionResidual, MissingSamplesDoNotReject) {
  int passed = 0;
  int asked = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Questionable loop = tests::closed_loop(tests::white(White::gaussian, 2000, seed), seed);
    for (std::size_t k = 0; k < 2000; ++k)
      if (k % 7 == 3 || (k > 600 && k < 900))
        loop.innovation[k] = loop.pv[k] = loop.op_percent[k] =
            std::numeric_limits<double>::quiet_NaN();
    for (const TestOutcome& answer : test_residual(loop.view())) {
      EXPECT_TRUE(answer.question.p > 0.0 && answer.question.p <= 1.0) << answer.question.name;
      passed += answer.question.p <= 0.05 ? 1 : 0;
      ++asked;
    }
  }
  EXPECT_LE(passed, asked * 0.05 + 4.0 * std::sqrt(asked * 0.05));
}

TEST(QuestionResidual, QuestionsThatCannotBeAskedAreLeftOut) {
  const Series r = tests::white(White::gaussian, 1000, 1);
  const Series none(1000, std::numeric_limits<double>::quiet_NaN());
  const auto answers = test_residual({r, none, none, none, none, 1.0});
  EXPECT_EQ(answers.size(), 4U) << "white, time_spread, time_event, periodic";
  EXPECT_EQ(tests::answer_of(answers, "op_direction"), nullptr);
  EXPECT_TRUE(test_residual({none, none, none, none, none, 1.0}).empty());
  EXPECT_TRUE(test_residual({}).empty());
  const Series constant(1000, 50.0);
  EXPECT_EQ(test_residual({r, constant, constant, constant, constant, 1.0}).size(), 4U);
}

TEST(QuestionResidual, WrongArgumentsAreRefused) {
  const Series r(500), shorter(499);
  EXPECT_THROW((void)test_residual({r, shorter, r, r, r, 1.0}), std::invalid_argument);
  EXPECT_THROW((void)test_residual({r, r, r, r, r, 0.0}), std::invalid_argument);
}

TEST(QuestionResidual, ScaleDoesNotMatter) {
  const Questionable loop = tests::closed_loop(tests::white(White::gaussian, 1500, 8), 8);
  Questionable scaled = loop;
  for (Series* signal : {&scaled.innovation, &scaled.response, &scaled.pv})
    for (double& value : *signal) value *= 0x1p300;
  const auto a = test_residual(loop.view());
  const auto b = test_residual(scaled.view());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i].question.p, b[i].question.p, 1e-9) << a[i].question.name;
}

}  // namespace
}  // namespace loopscope::core::model
