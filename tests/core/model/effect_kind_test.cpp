#include "core/model/effect_kind.hpp"

#include <gtest/gtest.h>
#include <set>

namespace loopscope::core::model {
namespace {

using enum EffectKind;

TEST(EffectKind, EveryKindHasAWordOfItsOwn) {
  std::set<std::string_view> words;
  for (const EffectKind kind : all_effect_kinds()) words.insert(name(kind));
  EXPECT_EQ(words.size(), all_effect_kinds().size());
  EXPECT_FALSE(words.contains(""));
}

TEST(EffectKind, CausesAreThoseOfOneVerdict) {
  EXPECT_TRUE(same_cause(external_oscillation, load_step));
  EXPECT_TRUE(same_cause(sensor_hold, sensor_quantisation));
  EXPECT_FALSE(same_cause(valve_stiction, valve_deadband));
  for (const EffectKind kind : all_effect_kinds()) EXPECT_TRUE(same_cause(kind, kind));
}

TEST(EffectKind, TheValveBendsTheFlowButItsTrimDoesNot) {
  EXPECT_TRUE(bends_flow(valve_deadband));
  EXPECT_TRUE(bends_flow(valve_saturation));
  EXPECT_FALSE(bends_flow(valve_characteristic));  // a column of the fit
  EXPECT_FALSE(is_valve_hysteresis(valve_saturation));
}

}  // namespace
}  // namespace loopscope::core::model
