#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <string_view>

#include "tests/core/diagnosis/field_tallies.hpp"
#include "tests/core/model/family_balance.hpp"
#include "tests/core/model/field_families.hpp"

/// The whole program's verdict, valve_stiction or not, on recordings as plants make them.
namespace loopscope::core::diagnosis {
namespace {

using loopscope::tests::model::FamilyBalance;
using loopscope::tests::model::field_families;
using loopscope::tests::model::FieldFamily;
using tests::right;
using tests::tally;

TEST(FieldVerdicts, StickingValvesAreNamedAndHealthyLoopsAreNot) {
  constexpr std::array<std::string_view, 8> kSome = {"stiction_flow_he",
                                                     "stiction_temperature_karnopp",
                                                     "stiction_complicated_flow",
                                                     "stiction_cascade",
                                                     "sine_flow",
                                                     "tight_level",
                                                     "wandering_flow",
                                                     "quantised"};
  FamilyBalance balance;
  for (const FieldFamily& family : field_families()) {
    if (std::ranges::find(kSome, family.name) == kSome.end()) continue;
    balance.add(family.sticks, right(family, tally(family, 10, 8)));
  }
  EXPECT_GE(balance.sensitivity(), 0.8);
  EXPECT_GE(balance.specificity(), 0.8);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
