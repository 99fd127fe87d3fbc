#include "core/model/residual_tests/nominations.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::model {
namespace {

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
