#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

#include <gtest/gtest.h>
#include <set>

namespace loopscope::core::diagnosis {
namespace {

TEST(Catalogue, EveryCodeHasItsOwnNameAndWords) {
  std::set<std::string_view> names, summaries, meanings;
  for (const CatalogueEntry& entry : catalogue()) {
    EXPECT_EQ(&catalogue_entry(entry.code), &entry);
    EXPECT_EQ(verdict_code(entry.name), entry.code);
    names.insert(entry.name);
    summaries.insert(entry.summary);
    meanings.insert(entry.meaning);
    EXPECT_FALSE(entry.action.empty());
  }
  EXPECT_EQ(names.size(), 16U);
  EXPECT_EQ(summaries.size(), names.size());
  EXPECT_EQ(meanings.size(), names.size());
}

TEST(Catalogue, FaultsHaveAWeightAFamilyAndSomethingToBlame) {
  for (const CatalogueEntry& entry : catalogue()) {
    const bool fault = entry.code != VerdictCode::healthy &&
                       entry.code != VerdictCode::not_controlling &&
                       entry.code != VerdictCode::insufficient_data;
    EXPECT_EQ(entry.weight > 0.0, fault) << entry.name;
    EXPECT_EQ(!entry.family.empty(), fault) << entry.name;
    EXPECT_EQ(entry.blames != plant::Fault::none, fault) << entry.name;
  }
}

TEST(Catalogue, ValveAndSensorFaultsWithholdTuningAndNothingElse) {
  for (const CatalogueEntry& entry : catalogue()) {
    const bool hardware =
        entry.name.starts_with("valve_") || entry.code == VerdictCode::sensor_fault;
    EXPECT_EQ(entry.withholds_tuning, hardware) << entry.name;
  }
}

TEST(Catalogue, ValvesAreBlamedAsFrictionOrValve) {
  for (const CatalogueEntry& entry : catalogue()) {
    const bool valve =
        entry.blames == plant::Fault::friction || entry.blames == plant::Fault::valve;
    EXPECT_EQ(valve, entry.name.starts_with("valve_")) << entry.name;
  }
}

TEST(Catalogue, NoWordThatIsNone) {
  EXPECT_EQ(verdict_code("stiction"), std::nullopt);
  EXPECT_EQ(verdict_code(""), std::nullopt);
  EXPECT_EQ(all_verdict_codes().size(), catalogue().size());
}

}  // namespace
}  // namespace loopscope::core::diagnosis
