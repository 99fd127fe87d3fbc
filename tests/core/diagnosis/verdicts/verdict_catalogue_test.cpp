#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

#include <gtest/gtest.h>
#include <set>
#include <utility>

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

TEST(PlantMember, TakesTheCausesTogetherThatTellNeighboursTheSame) {
  Verdict verdict;
  verdict.code = VerdictCode::valve_stiction;
  verdict.confidence = 0.8;
  for (const auto& [code, probability] :
       {std::pair(VerdictCode::valve_stiction, 0.8), std::pair(VerdictCode::valve_deadband, 0.5),
        std::pair(VerdictCode::valve_saturation, 0.7),
        std::pair(VerdictCode::external_disturbance, 0.3)}) {
    verdict.causes.emplace_back();
    verdict.causes.back().code = code;
    verdict.causes.back().probability = probability;
  }
  const plant::OwnFindings own = own_findings(verdict);
  EXPECT_EQ(own.fault, plant::Fault::friction);
  EXPECT_EQ(own.confidence, 0.8);
  EXPECT_NEAR(own.friction_p, 0.9, 1e-12) << "one of the two, or both";
  EXPECT_NEAR(own.outside_p, 0.3, 1e-12);
}

TEST(PlantMember, WhereNothingWasWeighedNothingIsSaid) {
  const plant::OwnFindings own = own_findings(Verdict{});
  EXPECT_EQ(own.fault, plant::Fault::none);
  EXPECT_EQ(own.friction_p, 0.0);
  EXPECT_EQ(own.outside_p, 0.0);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
