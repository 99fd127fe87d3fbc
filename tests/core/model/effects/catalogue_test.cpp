#include "core/model/effects/catalogue.hpp"

#include <gtest/gtest.h>

#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/valve.hpp"

namespace loopscope::core::model {
namespace {

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

}  // namespace
}  // namespace loopscope::core::model
