#include "core/model/selection/steps_after_moves.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using testing::HasSubstr;

using loopscope::tests::kWindow;
using tests::kInterval;
constexpr double kDelay = 6.0;      // samples
constexpr std::size_t kPace = 200;  // samples between moves

/// Moves up and down every kPace samples, from kPace on.
std::vector<double> stepped_setpoint() {
  std::vector<double> sp;
  for (std::size_t k = 0; k < kWindow; ++k) sp.push_back(static_cast<double>(k / kPace % 2));
  return sp;
}

Explanation with_load_steps(const std::vector<double>& at_samples) {
  Explanation explanation;
  explanation.baseline.process.delay_s = kDelay * kInterval;
  for (const double at : at_samples) {
    Step step;
    step.effect = EffectKind::load_step;
    step.parameters = {{"at", "s", at * kInterval, {}, {}}, {"size", "pv", 1.0, {}, {}}};
    explanation.steps.push_back(step);
  }
  return explanation;
}

Explanation judged(const std::vector<double>& sp, const std::vector<double>& at_samples) {
  Explanation explanation = with_load_steps(at_samples);
  ModelInput input;
  input.sp = sp;
  input.sample_interval_s = kInterval;
  find_steps_after_moves(input, 1, explanation);
  return explanation;
}

/// In manual from 700 to 800, where sp goes after pv, and back to where it was.
TEST(StepsAfterMoves, NothingAnswersASetpointInManual) {
  std::vector<double> sp(kWindow, 5.0), pv(kWindow, 5.0), error(kWindow, 0.0);
  for (std::size_t k = 700; k < 800; ++k) {
    sp[k] = pv[k] = 5.0 + 0.1 * static_cast<double>(k % 7);
    error[k] = std::nan("");
  }
  Explanation explanation = with_load_steps({750.0});
  ModelInput input;
  input.sp = sp;
  input.pv = pv;
  input.sample_interval_s = kInterval;
  find_steps_after_moves(input, 1, explanation);
  EXPECT_LT(explanation.steps[0].setpoint_chance, 0.05) << "as if the controller had been at work";
  explanation = with_load_steps({750.0});
  input.error = error;
  find_steps_after_moves(input, 1, explanation);
  EXPECT_EQ(explanation.steps[0].setpoint_chance, 1.0);
}

/// From 4 samples before a move to 2 x 6 + 8 after it: 25 of 200 samples.
const double kShare = 20.0 * 25.0 / static_cast<double>(kWindow);

TEST(StepsAfterMoves, OneComesWithAMoveAsOftenAsTheAnswersLast) {
  const std::vector<double> sp = stepped_setpoint();
  EXPECT_NEAR(judged(sp, {3 * kPace + 7.0}).steps[0].setpoint_chance, kShare, 1e-12);
  EXPECT_EQ(judged(sp, {3 * kPace + 60.0}).steps[0].setpoint_chance, 1.0);
}

TEST(StepsAfterMoves, ThreeOfThreeDoSoHardlyByChance) {
  const Explanation explanation =
      judged(stepped_setpoint(), {3 * kPace + 7.0, 9 * kPace + 9.0, 5 * kPace + 6.0});
  for (const Step& step : explanation.steps) {
    EXPECT_NEAR(step.setpoint_chance, std::pow(kShare, 3), 1e-12);
    EXPECT_EQ(step.statement,
              " It begins when the loop responds to its setpoint, as do 3 of 3 (by chance: 0 %); "
              "rather than a load, it may be a response that differs from the model's.");
  }
}

TEST(StepsAfterMoves, StepsCloseTogetherAreOne) {
  const Explanation explanation =
      judged(stepped_setpoint(), {3 * kPace + 7.0, 3 * kPace + 9.0, 3 * kPace + 12.0});
  EXPECT_NEAR(explanation.steps[0].setpoint_chance, kShare, 1e-12);
}

TEST(StepsAfterMoves, OneOfThreeSaysNothing) {
  const Explanation explanation =
      judged(stepped_setpoint(), {3 * kPace + 7.0, 9 * kPace + 90.0, 5 * kPace + 60.0});
  EXPECT_NEAR(explanation.steps[0].setpoint_chance, 1.0 - std::pow(1.0 - kShare, 3), 1e-12);
  EXPECT_EQ(explanation.steps[0].statement, "");
  EXPECT_EQ(explanation.steps[1].setpoint_chance, 1.0);
}

TEST(StepsAfterMoves, OfARampItsBeginningAndItsEndCount) {
  std::vector<double> sp(kWindow, 0.0);
  for (std::size_t k = 1000; k < kWindow; ++k)
    sp[k] = std::min(1.0, (static_cast<double>(k) - 999.0) / 500.0);
  EXPECT_LT(judged(sp, {1007.0}).steps[0].setpoint_chance, 0.05);
  EXPECT_EQ(judged(sp, {1250.0}).steps[0].setpoint_chance, 1.0);
  EXPECT_LT(judged(sp, {1507.0}).steps[0].setpoint_chance, 0.05);
}

TEST(StepsAfterMoves, ASetpointThatNeverRestsProvesNothing) {
  std::vector<double> sp;
  for (std::size_t k = 0; k < kWindow; ++k) sp.push_back(k % 2 == 0 ? 0.0 : 1.0);
  EXPECT_NEAR(judged(sp, {700.0, 900.0, 2000.0}).steps[0].setpoint_chance, 1.0, 1e-2);
}

TEST(StepsAfterMoves, AMoveTooSmallToShowExplainsNoLoad) {
  std::vector<double> sp = stepped_setpoint();
  std::vector<double> pv;
  for (std::size_t k = 0; k < kWindow; ++k) pv.push_back(k % 2 == 0 ? -1.0 : 1.0);
  Explanation explanation = with_load_steps({3 * kPace + 7.0});
  ModelInput input;
  input.sp = sp;
  input.pv = pv;
  input.sample_interval_s = kInterval;
  find_steps_after_moves(input, 1, explanation);
  EXPECT_LT(explanation.steps[0].setpoint_chance, 0.2);
  for (double& value : sp) value *= 0.05;
  explanation = with_load_steps({3 * kPace + 7.0});
  find_steps_after_moves(input, 1, explanation);
  EXPECT_EQ(explanation.steps[0].setpoint_chance, 1.0);
}

TEST(StepsAfterMoves, WithoutASetpointOrAMoveNothingIsBlamed) {
  EXPECT_EQ(judged({}, {700.0}).steps[0].setpoint_chance, 1.0);
  EXPECT_EQ(judged(std::vector<double>(kWindow, 5.0), {700.0}).steps[0].setpoint_chance, 1.0);
}

TEST(StepsAfterMoves, OtherEffectsAreLeftAlone) {
  Explanation explanation = with_load_steps({3 * kPace + 7.0});
  explanation.steps[0].effect = EffectKind::gain_change;
  const std::vector<double> sp = stepped_setpoint();
  ModelInput input;
  input.sp = sp;
  find_steps_after_moves(input, 1, explanation);
  EXPECT_EQ(explanation.steps[0].setpoint_chance, 1.0);
}

/// Loads at any time, one to three a record.
TEST(StepsAfterMoves, LoadsAreBlamedInAtMostTheShareThatTheChanceSays) {
  constexpr int kRecords = 3000;
  std::mt19937_64 random(20260);
  std::uniform_real_distribution<double> anywhere(0.0, kWindow - 1.0);
  std::uniform_int_distribution<std::size_t> how_many(1, 3);
  const std::vector<double> sp = stepped_setpoint();
  int blamed = 0;
  for (int record = 0; record < kRecords; ++record) {
    std::vector<double> at(how_many(random));
    for (double& sample : at) sample = anywhere(random);
    const Explanation explanation = judged(sp, at);
    const auto follows = [](const Step& step) { return step.setpoint_chance <= 0.05; };
    blamed += std::ranges::any_of(explanation.steps, follows) ? 1 : 0;
  }
  EXPECT_LE(blamed, 0.05 * kRecords);
  EXPECT_GE(blamed, 0.005 * kRecords) << "the chance would say too much";
}

}  // namespace
}  // namespace loopscope::core::model
