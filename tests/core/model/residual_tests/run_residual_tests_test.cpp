#include "core/model/residual_tests/run_residual_tests.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/model/fit/baseline.hpp"
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

std::vector<TestOutcome> answers_of(std::string_view scenario, std::uint64_t seed,
                                    const RowGrid& grid = {}) {
  const auto record = simulate::simulate_scenario(scenario, {}, seed);
  const LoopData data = make_loop_data(record.pv, record.op, record.sample_interval_s, grid);
  const std::vector<double> pv = at_rows(grid, record.pv), op = at_rows(grid, record.op);
  const ModelInput input{pv, op, {}, {}, record.sample_interval_s};
  return run_residual_tests(input, data, search_process(data, {}));
}

TEST(PutQuestions, OpsDirectionMattersToALoopWithPlayAndToNoHealthyOne) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_LT(p_of(answers_of("deadband", seed), "op_direction"), 1e-6) << seed;
  int healthy = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    healthy += p_of(answers_of("healthy_flow", seed), "op_direction") < 0.05 ? 1 : 0;
  EXPECT_LE(healthy, 4);  // one in twenty by chance
}

/// Residuals are there at the renewals only; op is read there too.
TEST(PutQuestions, OfAHeldSensorOpsDirectionIsReadAtTheRenewals) {
  const double p = p_of(answers_of("deadband", 1, {3, 0}), "op_direction");
  EXPECT_GT(p, 0.0);
  EXPECT_LT(p, 1.0);
}

TestOutcome answer(std::string_view test, double p, std::vector<Nomination> nominations) {
  return {{test, p, "saw something"}, std::move(nominations)};
}

std::vector<TestOutcome> two_tests() {
  using enum EffectKind;
  return {answer("op_direction", 1e-4,
                 {{.effect = valve_stiction, .p = 1e-4}, {.effect = valve_deadband, .p = 1e-4}}),
          answer("periodic", 1e-9,
                 {{.effect = external_oscillation, .p = 1e-9},
                  {.effect = external_oscillation, .p = 0.02}}),
          answer("time_gain", 0.02, {{.effect = gain_change, .p = 0.02}})};
}

TEST(Nominations, TheMostSignificantPromisesMost) {
  const Nominations asked(two_tests());
  EXPECT_EQ(asked.rank(EffectKind::external_oscillation), 1U);
  EXPECT_EQ(asked.rank(EffectKind::valve_stiction), 2U);
  EXPECT_EQ(asked.nominations(EffectKind::external_oscillation).size(), 1U);
}

TEST(Nominations, APromiseIsTheEvidenceThatTheTestComesTo) {
  const Nominations asked(two_tests());
  EXPECT_NEAR(asked.promise(EffectKind::valve_deadband), -2.0 * std::log(1e-4), 1e-12);
  EXPECT_NEAR(asked.promise(EffectKind::external_oscillation), -2.0 * std::log(1e-9), 1e-12);
  EXPECT_EQ(asked.promise(EffectKind::gain_change), 0.0);
}

/// The two are one search, told apart by the jump that it ends with.
TEST(Nominations, PlayAndStictionShareARank) {
  const Nominations asked(two_tests());
  EXPECT_EQ(asked.rank(EffectKind::valve_deadband), asked.rank(EffectKind::valve_stiction));
}

TEST(Nominations, AboveOneInAHundredNobodyAsks) {
  const Nominations asked(two_tests());
  EXPECT_FALSE(asked.for_effect(EffectKind::gain_change));
  EXPECT_EQ(asked.rank(EffectKind::gain_change), 0U);
  EXPECT_TRUE(asked_by(EffectKind::gain_change, two_tests(), {}).empty());
}

TEST(Nominations, WhoAskedIsToldWithWhatHeSaysAfterwards) {
  const std::vector<TestOutcome> after = {answer("op_direction", 0.4, {})};
  const auto by = asked_by(EffectKind::valve_deadband, two_tests(), after);
  ASSERT_EQ(by.size(), 1U);
  EXPECT_EQ(by.front().test, "op_direction");
  EXPECT_EQ(by.front().p, 1e-4);
  EXPECT_EQ(by.front().p_after, 0.4);
  EXPECT_EQ(by.front().statement, "saw something");
  EXPECT_FALSE(asked_by(EffectKind::valve_deadband, two_tests(), {}).front().p_after);
}

TEST(Nominations, WhatIsLeftIsInLogarithmsOfP) {
  const auto by = [](double p, std::optional<double> after) {
    return std::vector<AskedBy>{{"op_direction", p, after, {}}};
  };
  EXPECT_EQ(share_left(by(1e-10, 1.0)), 0.0);
  EXPECT_NEAR(share_left(by(1e-10, 1e-5)), 0.5, 1e-12);
  EXPECT_EQ(share_left(by(1e-10, 1e-20)), 1.0);
  EXPECT_EQ(share_left(by(1e-10, std::nullopt)), 0.0);
  EXPECT_EQ(share_left({}), 0.0);
}

TEST(Nominations, EffectsAreToldByPromise) {
  const auto effects = asked_effects(two_tests());
  ASSERT_EQ(effects.size(), 3U);
  EXPECT_EQ(effects.front().effect, EffectKind::external_oscillation);
  EXPECT_EQ(effects.front().test, "periodic");
}

}  // namespace
}  // namespace loopscope::core::model
