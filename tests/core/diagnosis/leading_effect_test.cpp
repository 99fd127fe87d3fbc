#include "core/diagnosis/leading_effect.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using enum model::EffectKind;

TEST(LeadingEffect, TheLargestDropLeadsNotTheFirstStep) {
  const auto explanation = explanation_of(
      {clear_step(valve_deadband, 1.0, 0.9), clear_step(external_oscillation, 0.9, 0.3)});
  const LeadingEffect leading = leading_effect(explanation);
  EXPECT_EQ(leading.code, VerdictCode::external_disturbance);
  EXPECT_EQ(leading.strongest, &explanation.steps[1]);
  EXPECT_NEAR(leading.share, std::log(3.0) / std::log(1.0 / 0.3), 1e-12);
}

TEST(LeadingEffect, StepsOfOneVerdictCountTogether) {
  const auto explanation =
      explanation_of({clear_step(valve_stiction, 1.0, 0.6), clear_step(load_step, 0.6, 0.4),
                      clear_step(external_oscillation, 0.4, 0.25)});
  const LeadingEffect leading = leading_effect(explanation);
  EXPECT_EQ(leading.code, VerdictCode::external_disturbance);
  EXPECT_EQ(leading.strongest, &explanation.steps[2]) << "of its two the one that explains more";
}

TEST(LeadingEffect, OfLoadStepsBesideAValveOnlyTheLargestCounts) {
  const auto explanation =
      explanation_of({clear_step(valve_stiction, 1.0, 0.6), clear_step(load_step, 0.6, 0.4),
                      clear_step(load_step, 0.4, 0.3), clear_step(load_step, 0.3, 0.2)});
  EXPECT_EQ(leading_effect(explanation).code, VerdictCode::valve_stiction);
}

TEST(LeadingEffect, LoadsThatComeWithTheAnswerToTheSetpointLeadUnnamed) {
  model::Step first = clear_step(load_step, 0.9, 0.7);
  model::Step second = clear_step(load_step, 0.7, 0.6);
  first.setpoint_chance = second.setpoint_chance = 0.01;
  const auto explanation = explanation_of({clear_step(valve_stiction, 1.0, 0.9), first, second});
  const LeadingEffect leading = leading_effect(explanation);
  EXPECT_EQ(leading.code, VerdictCode::unexplained);
  EXPECT_EQ(leading.strongest, &explanation.steps[1]);
}

TEST(LeadingEffect, SlipsOfAValveAtMovesOfTheSetpointDoNotHideIt) {
  model::Step slip = clear_step(load_step, 0.6, 0.5);
  model::Step another = clear_step(load_step, 0.5, 0.3);
  slip.setpoint_chance = another.setpoint_chance = 0.01;
  const auto explanation = explanation_of({clear_step(valve_stiction, 1.0, 0.6), slip, another});
  EXPECT_EQ(leading_effect(explanation).code, VerdictCode::valve_stiction);
}

TEST(LeadingEffect, LoadStepsAloneCountTogether) {
  const auto explanation =
      explanation_of({clear_step(external_oscillation, 1.0, 0.8), clear_step(load_step, 0.8, 0.7),
                      clear_step(load_step, 0.7, 0.6)});
  EXPECT_EQ(leading_effect(explanation).share, 1.0);
}

TEST(LeadingEffect, WithoutAnyDropTheFirstLeads) {
  const auto explanation =
      explanation_of({clear_step(sensor_quantisation, 1.0, 1.0), clear_step(load_step, 1.0, 1.0)});
  EXPECT_EQ(leading_effect(explanation).code, VerdictCode::sensor_fault);
  EXPECT_EQ(leading_effect(explanation).share, 1.0);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
