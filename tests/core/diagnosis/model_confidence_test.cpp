#include "core/diagnosis/model_confidence.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using enum model::EffectKind;

/// A clear story, changed by `change`.
template <typename Change>
double confidence_after(Change change) {
  model::Explanation explanation = explanation_of({clear_step(valve_stiction)});
  change(explanation);
  return confidence_of(explanation);
}

const double kClear = confidence_after([](model::Explanation&) {});

TEST(ModelConfidence, AClearStoryIsBelieved) {
  EXPECT_GT(kClear, 0.9);
  EXPECT_LT(kClear, 1.0);
}

TEST(ModelConfidence, EvidenceSaturates) {
  const auto with = [](double evidence) {
    return confidence_after([&](auto& e) { e.steps[0].evidence = evidence; });
  };
  EXPECT_EQ(with(0.0), 0.0);
  EXPECT_EQ(with(-5.0), 0.0);
  EXPECT_LT(with(10.0), with(30.0));
  EXPECT_NEAR(with(200.0), with(20000.0), 1e-3);
}

TEST(ModelConfidence, HowRareEvidenceIsAmongHealthyLoopsIsMeasured) {
  model::Step step = clear_step(valve_stiction);
  step.p = 1e-300;
  for (const auto& [evidence, p] : {std::pair{0.0, 0.02}, {25.0, 0.00736}, {400.0, 2.25e-9}}) {
    step.evidence = evidence;
    EXPECT_NEAR(measured_p(step), p, 0.01 * p);
  }
  step.p = 0.001;
  EXPECT_EQ(measured_p(step), 0.001) << "never below the step's own";
  step.evidence = std::nan("");
  EXPECT_EQ(measured_p(step), 1.0);
}

TEST(ModelConfidence, ARivalAsGoodHalvesIt) {
  EXPECT_NEAR(confidence_after([](auto& e) { e.steps[0].margin = 0.0; }), 0.5 * kClear, 1e-9);
  EXPECT_LT(confidence_after([](auto& e) { e.steps[0].margin = -20.0; }), 0.2 * kClear);
}

TEST(ModelConfidence, AnEffectInHalfOfTheRecordIsBelievedLess) {
  EXPECT_NEAR(confidence_after([](auto& e) { e.steps[0].steadiness = 0.5; }), 0.75 * kClear, 1e-9);
}

TEST(ModelConfidence, WhatHappensOnceOwesNoSteadiness) {
  for (const model::EffectKind effect : {load_step, gain_change}) {
    EXPECT_EQ(confidence_after([effect](auto& e) {
                e.steps[0].effect = effect;
                e.steps[0].steadiness = 0.1;
              }),
              kClear);
  }
}

TEST(ModelConfidence, ALoadThatMayBeTheAnswerToTheSetpointIsBelievedLess) {
  const auto with = [](double chance) {
    return confidence_after([&](auto& e) {
      e.steps[0].effect = load_step;
      e.steps[0].setpoint_chance = chance;
    });
  };
  EXPECT_NEAR(with(1.0 / 9.0), 0.5 * kClear, 1e-9) << "the odds are even";
  EXPECT_GT(with(0.5), 0.8 * kClear);
  EXPECT_GT(with(0.001), 0.95 * kClear) << "that it is no load";
}

TEST(ModelConfidence, WhatIsLeftOverCosts) {
  const double half = confidence_after([](auto& e) { e.unexplained.fraction = 0.5; });
  const double all = confidence_after([](auto& e) { e.unexplained.fraction = 1.5; });
  EXPECT_LT(half, 0.8 * kClear);
  EXPECT_LT(all, half);
  EXPECT_GT(all, 0.0);
}

TEST(ModelConfidence, AStructuredRestHoldsItAtSixTenths) {
  EXPECT_EQ(confidence_after([](auto& e) { e.unexplained.whiteness_p = 1e-8; }), 0.6);
  EXPECT_EQ(confidence_after([](auto& e) { e.questions[1].p = 1e-8; }), 0.6);
  EXPECT_LT(confidence_after([](auto& e) {
              e.questions[1].p = 1e-8;
              e.steps[0].evidence = 5.0;
            }),
            0.3)
      << "a cap, not a floor";
}

TEST(ModelConfidence, QuestionsArePaidFor) {
  model::Explanation explanation = explanation_of();
  explanation.questions[0].p = 0.01;
  EXPECT_DOUBLE_EQ(structure_p(explanation), 0.03);
  explanation.questions[0].p = 0.9;
  explanation.unexplained.whiteness_p = 0.8;
  EXPECT_EQ(structure_p(explanation), 1.0);
  explanation.questions.clear();
  explanation.unexplained.whiteness_p = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(structure_p(explanation), 1.0);
}

TEST(ModelConfidence, OfTwoVerdictsOfEqualWeightTheChoiceIsATossUp) {
  const double both = confidence_after(
      [](auto& e) { e.steps.push_back(clear_step(external_oscillation, 0.5, 0.25)); });
  EXPECT_NEAR(both, 0.75 * kClear, 1e-9);
}

TEST(ModelConfidence, NoStepNoConfidenceAndNothingThatIsNoNumber) {
  EXPECT_EQ(confidence_of(explanation_of()), 0.0);
  const double confidence = confidence_after([](auto& e) {
    e.steps[0].margin = std::numeric_limits<double>::quiet_NaN();
    e.steps[0].steadiness = std::numeric_limits<double>::quiet_NaN();
    e.unexplained.fraction = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_GE(confidence, 0.0);
  EXPECT_LT(confidence, 0.3);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
