#include "core/model/effects/effect_catalogue.hpp"

#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include "core/model/effects/curvature.hpp"
#include "core/model/effects/exponential_trim.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/input_load.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/effects/square_root_outflow.hpp"
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

std::string said(const Effect& effect, const std::vector<double>& values) {
  std::vector<Parameter> parameters;
  for (const double value : values) parameters.push_back({"", "", value, {}, {}});
  return effect.words(parameters);
}

TEST(Catalogue, EveryEffectSaysInASentenceWhatItDoes) {
  EXPECT_EQ(said(ValveEffect({ValveLaw::kano, 4.0, 2.0, 1.0}), {4.0, 2.0}),
            "The valve sticks: after a reversal it stands still until the controller output has "
            "moved 4 %, then jumps by 2 % (stiction model of Kano).");
  EXPECT_EQ(said(ValveEffect({ValveLaw::kano, 4.0, 0.0, 1.0}), {4.0}),
            "The valve has 4 % of dead band (backlash): after each reversal the controller output "
            "moves that far before the valve follows.");
  EXPECT_EQ(said(Saturation(-10.0, 4.0), {40.0, 54.0}),
            "The valve follows the controller output between 40 and 54 % only.");
  const std::string curved =
      "The flow is not proportional to the valve's travel: curvature 0.4, the gain changes with "
      "the output.";
  EXPECT_EQ(said(ValveCharacteristic(), {0.4}), curved);
  EXPECT_EQ(said(ExponentialTrim(0.4, 20.0), {0.4}), curved);
  EXPECT_EQ(said(ProcessNonlinearity(), {-0.4}),
            "The process gain depends on the operating point: curvature -0.4, the gain changes "
            "with the process variable.");
  EXPECT_EQ(said(SquareRootOutflow(50.0), {0.4}),
            "The process behaves as a vessel whose outflow grows with the square root of its "
            "level: curvature 0.4, gain and time constant change with the process variable.");
  EXPECT_EQ(said(LoadStep(500), {1500.0, -12.0}),
            "The load moved 25 min into the window, by -12 units of pv, and stayed.");
  EXPECT_EQ(
      said(InputLoad(300, 600), {90.0, 3.0}),
      "The load before the process moved 90 s into the window, by 3 units of pv, and stayed.");
  EXPECT_EQ(said(GainChange(300, 300), {1500.0, 0.5}),
            "The gain of the process changes to 0.5 times what it was, from 25 min into the "
            "window on.");
  EXPECT_EQ(said(GainChange(300, 900), {1500.0, 2.0}),
            "The gain of the process drifts to 2 times what it was, from 25 min into the window "
            "on.");
}

TEST(Catalogue, AWaveSaysItsPeriodAndItsShape) {
  const std::string period = "An oscillation of period 2.5 min";
  const std::string end = " reaches the loop from outside, amplitude 0.8 units of pv.";
  EXPECT_EQ(said(ExternalOscillation(50.0), {150.0, 0.8}), period + end);
  EXPECT_EQ(said(ExternalOscillation(50.0, 3), {150.0, 0.8}), period + " and with harmonics" + end);
  EXPECT_EQ(said(ExternalOscillation(50.0, 1, 4), {150.0, 0.8}),
            period + ", slowly changing," + end);
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
