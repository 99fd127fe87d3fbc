#include "core/simulate/effect.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

#include "core/simulate/effect_chain.hpp"

namespace loopscope::core::simulate {
namespace {

TEST(Effect, DescriptionsAreInTheOrderOfTheVariantAndAccepted) {
  ASSERT_EQ(all_effects().size(), std::variant_size_v<Effect>);
  for (std::size_t i = 0; i < all_effects().size(); ++i) {
    const EffectDescription& description = all_effects()[i];
    const Effect effect = make_effect(description.name, {});
    EXPECT_EQ(effect.index(), i);
    EXPECT_EQ(name(effect), description.name);
    for (const std::string_view parameter : description.parameters) {
      const EffectArgument argument{std::string(parameter), parameter == "law" ? "kano" : "no"};
      if (parameter == "law") {
        EXPECT_NO_THROW((void)make_effect(description.name, {&argument, 1}));
      } else {
        // Known, and read as a number.
        EXPECT_THROW((void)make_effect(description.name, {&argument, 1}), std::invalid_argument);
      }
    }
  }
}

TEST(Effect, ArgumentsReachTheirParameters) {
  const std::vector<EffectArgument> arguments = {{"S", "5"}, {"J", "2.5"}, {"law", "kano"}};
  const auto stiction = std::get<ValveStiction>(make_effect("valve_stiction", arguments));
  EXPECT_EQ(stiction.stickband_percent, 5.0);
  EXPECT_EQ(stiction.slip_jump_percent, 2.5);
  EXPECT_EQ(stiction.law, StictionLaw::kano);
  const std::vector<EffectArgument> ramp = {{"at", "7"}, {"rate", "3"}, {"ratio", "4"}};
  const auto change = std::get<GainChange>(make_effect("gain_change", ramp));
  EXPECT_EQ(change.at_s, 7.0);
  EXPECT_EQ(change.rate_per_hour, 3.0);
  EXPECT_EQ(change.ratio, 4.0);
}

TEST(Effect, RefusesWhatItDoesNotKnow) {
  const EffectArgument wrong_name{"s", "3"};
  const EffectArgument wrong_law{"law", "printed"};
  const EffectArgument out_of_range{"J", "4"};
  EXPECT_THROW((void)make_effect("stiction", {}), std::invalid_argument);
  for (const EffectArgument& argument : {wrong_name, wrong_law, out_of_range}) {
    EXPECT_THROW((void)make_effect("valve_stiction", {&argument, 1}), std::invalid_argument);
  }
}

TEST(EffectChain, WithoutEffectsPassesEverything) {
  EffectChain chain({});
  EXPECT_EQ(chain.valve_position(12.0, 0.0), 12.0);
  EXPECT_EQ(chain.flow(12.0, 0.0), 12.0);
  EXPECT_EQ(chain.process_input(12.0, 0.0), 12.0);
  EXPECT_EQ(chain.process_output(12.0, 0.0), 12.0);
  EXPECT_EQ(chain.load(12.0, 0.0), 12.0);
  EXPECT_EQ(chain.measured(12.0, 0.0), 12.0);
}

TEST(EffectChain, TheOrderOfTheListDoesNotMatter) {
  // Play before the stop: 62 -> 61 -> 60. The other way round 62 -> 60 -> 59 would come out.
  const std::vector<Effect> listed = {ValveSaturation{0.0, 60.0}, ValveDeadband{2.0}};
  EffectChain chain(listed);
  chain.valve_position(50.0, 0.0);
  EXPECT_EQ(chain.valve_position(62.0, 1.0), 60.0);
}

}  // namespace
}  // namespace loopscope::core::simulate
