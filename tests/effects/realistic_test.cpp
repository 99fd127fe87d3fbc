#include "tests/effects/realistic.hpp"

#include <gtest/gtest.h>
#include <string>

#include "tests/effects/draft.hpp"
#include "tests/effects/explainable.hpp"

namespace loopscope::tests::effects {
namespace {

TEST(Realistic, EverySpreadEffectIsExplainableByItself) {
  for (const Recipe& recipe : all_recipes()) {
    const Finished finished = finish(recipe.info.name, 3);
    EXPECT_EQ(finished.draft.alone.size(), recipe.spread.size()) << recipe.info.name;
    for (const Scenario& alone : finished.draft.alone)
      EXPECT_GE(explainable({finished.draft.base, alone, simulate(alone)}), kLeastExplainable)
          << recipe.info.name;
  }
}

/// Of a kind with one effect, the loop with that effect alone is the record itself.
TEST(Realistic, TheEffectAloneIsTheOneOfTheRecord) {
  for (const char* kind : {"valve_stiction", "valve_characteristic", "process_nonlinearity",
                           "external_oscillation", "valve_saturation"}) {
    const Finished finished = finish(kind, 4);
    EXPECT_EQ(simulate(finished.draft.alone.front()).pv, finished.series.pv) << kind;
  }
}

TEST(Realistic, LeavesKindsWithoutSpreadEffectsAsTheyAre) {
  for (const char* kind : {"healthy_moving", "load_step", "sensor_hold", "controller_change"})
    EXPECT_EQ(generate(kind, 5).pv, generate(kind, 5, Size::faint).pv) << kind;
}

TEST(Realistic, FaintEffectsAreAsDrawn) {
  for (const Recipe& recipe : all_recipes(Size::faint))
    EXPECT_TRUE(recipe.spread.empty()) << recipe.info.name;
  EXPECT_NE(generate("gain_change", 5).pv, generate("gain_change", 5, Size::faint).pv);
}

}  // namespace
}  // namespace loopscope::tests::effects
