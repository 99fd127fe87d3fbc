#include "core/diagnosis/effect_verdict.hpp"

#include <gtest/gtest.h>

#include "core/model/effects/effect_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

using enum model::EffectKind;

TEST(EffectVerdict, EveryEffectHasTheVerdictOfTheContract) {
  EXPECT_EQ(verdict_of(valve_stiction), VerdictCode::valve_stiction);
  EXPECT_EQ(verdict_of(valve_deadband), VerdictCode::valve_deadband);
  EXPECT_EQ(verdict_of(valve_saturation), VerdictCode::valve_saturation);
  EXPECT_EQ(verdict_of(valve_characteristic), VerdictCode::valve_characteristic);
  EXPECT_EQ(verdict_of(process_nonlinearity), VerdictCode::process_nonlinearity);
  EXPECT_EQ(verdict_of(external_oscillation), VerdictCode::external_disturbance);
  EXPECT_EQ(verdict_of(load_step), VerdictCode::external_disturbance);
  EXPECT_EQ(verdict_of(gain_change), VerdictCode::process_change);
  EXPECT_EQ(verdict_of(sensor_quantisation), VerdictCode::sensor_fault);
  EXPECT_EQ(verdict_of(sensor_hold), VerdictCode::sensor_fault);
}

TEST(EffectVerdict, NoEffectIsForgotten) {
  for (const model::EffectKind effect : model::all_effect_kinds()) {
    EXPECT_NE(verdict_of(effect), VerdictCode::unexplained) << model::name(effect);
  }
}

TEST(EffectVerdict, PlayThatTheLoopCyclesAboutEndsAsStiction) {
  model::Step play;
  play.effect = valve_deadband;
  EXPECT_EQ(verdict_of(play), VerdictCode::valve_deadband);
  play.cycle_indicates_stiction = true;
  EXPECT_EQ(verdict_of(play), VerdictCode::valve_stiction);
}

TEST(EffectVerdict, ALoadThatComesWithTheAnswerToTheSetpointIsNone) {
  model::Step load;
  load.effect = load_step;
  load.setpoint_chance = 0.2;
  EXPECT_EQ(verdict_of(load), VerdictCode::external_disturbance);
  load.setpoint_chance = 0.02;
  EXPECT_EQ(verdict_of(load), VerdictCode::unexplained);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
