#include "core/model/effects/effect_catalogue.hpp"

#include <gtest/gtest.h>
#include <set>

#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/valve.hpp"

namespace loopscope::core::model {
namespace {

using enum EffectKind;

TEST(Catalogue, HasALineForEachKind) {
  for (const EffectKind kind : all_effect_kinds()) {
    const EffectTraits& traits = traits_of(kind);
    EXPECT_EQ(traits.kind, kind);
    EXPECT_FALSE(traits.word.empty());
    EXPECT_EQ(traits_of(traits.cause).cause, traits.cause) << "a cause names itself";
    EXPECT_GE(traits.most, 1);
  }
}

/// What is chosen from thousands of places gains more by chance.
TEST(Catalogue, WhatMayBeAnywhereHasToGainMore) {
  for (const EffectKind kind : all_effect_kinds()) {
    const EffectTraits& traits = traits_of(kind);
    if (traits.everywhere) {
      EXPECT_GT(traits.worth_fitting, kWorthFittingWhole) << traits.word;
    }
    if (traits.scored_once) {
      EXPECT_TRUE(traits.on_own_rows) << traits.word;
    }
  }
}

TEST(Catalogue, AnEffectSaysItselfWhatItIs) {
  EXPECT_EQ(LoadStep(500).moment(), 500U);
  EXPECT_EQ(GainChange(300, 300).moment(), 300U);
  EXPECT_FALSE(GainChange(300, 900).moment()) << "it drifts";
  const ValveEffect valve(Valve{});
  EXPECT_EQ(valve.as_valve(), &valve);
  EXPECT_FALSE(valve.as_wave());
  const ExternalOscillation wave(50.0);
  EXPECT_EQ(wave.as_wave(), &wave);
  EXPECT_FALSE(wave.as_valve() || wave.moment());
}

TEST(Catalogue, EveryKindHasAWordOfItsOwn) {
  std::set<std::string_view> words;
  for (const EffectKind kind : all_effect_kinds()) words.insert(name(kind));
  EXPECT_EQ(words.size(), all_effect_kinds().size());
  EXPECT_FALSE(words.contains(""));
}

TEST(Catalogue, CausesAreThoseOfOneVerdict) {
  EXPECT_TRUE(same_cause(external_oscillation, load_step));
  EXPECT_TRUE(same_cause(sensor_hold, sensor_quantisation));
  EXPECT_FALSE(same_cause(valve_stiction, valve_deadband));
  for (const EffectKind kind : all_effect_kinds()) EXPECT_TRUE(same_cause(kind, kind));
}

TEST(Catalogue, TheValveBendsTheFlowButItsTrimDoesNot) {
  EXPECT_TRUE(bends_flow(valve_deadband));
  EXPECT_TRUE(bends_flow(valve_saturation));
  EXPECT_FALSE(bends_flow(valve_characteristic));  // a column of the fit
  EXPECT_FALSE(is_valve_hysteresis(valve_saturation));
}

}  // namespace
}  // namespace loopscope::core::model
