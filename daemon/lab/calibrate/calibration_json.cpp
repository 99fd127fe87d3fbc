#include "daemon/lab/calibrate/calibration_json.hpp"

#include <fmt/format.h>

#include "daemon/lab/calibrate/calibration.hpp"
#include "daemon/lab/calibrate/cost.hpp"

namespace loopscope::daemon {
namespace {

using Json = nlohmann::ordered_json;

/// "at_0.05": share of records rejected at that level.
std::string level_key(double level) {
  return fmt::format("at_{}", level);
}

Json tests_json() {
  Json tests = Json::array();
  for (const RecordTest& test : record_tests()) {
    tests.push_back({{"name", test.name}, {"rejects_when", test.rule}});
  }
  return tests;
}

Json tally_json(const TestTally& tally) {
  if (tally.computed == 0) return nullptr;
  Json json = {{"computed", tally.computed}};
  for (std::size_t i = 0; i < kLevels.size(); ++i) {
    const BinomialShare share = binomial_share(tally.rejected[i], tally.computed);
    json[level_key(kLevels[i])] = {
        {"share", share.share}, {"low", share.low}, {"high", share.high}};
  }
  return json;
}

Json families_json(const Calibration& calibration) {
  Json families = Json::array();
  for (const FamilyTally& tally : calibration.families) {
    Json rejected;
    for (std::size_t i = 0; i < kRecordTests; ++i) {
      rejected[std::string(record_tests()[i].name)] = tally_json(tally.tests[i]);
    }
    families.push_back({{"name", tally.family.name},
                        {"description", tally.family.description},
                        {"kind", name(tally.family.kind)},
                        {"samples", tally.family.samples},
                        {"rejected", std::move(rejected)}});
  }
  return families;
}

Json cost_json(const Calibration& calibration) {
  const Cost cost = healthy_cost(calibration.families, calibration.records);
  Json ratios = Json::object();
  for (const FamilyTally& tally : calibration.families) {
    ratios[tally.family.name] = mean_cost({&tally, 1}, calibration.records).ratio();
  }
  return {{"estimate_us", cost.estimate_us},
          {"analyse_us", cost.analyse_us},
          {"ratio", cost.ratio()},
          {"ratio_by_family", std::move(ratios)}};
}

Json mean_json(const PlantMean& mean) {
  return {{"mean", mean.mean}, {"standard_error", mean.standard_error}};
}

Json plant_json(const PlantSummary& plant) {
  Json families = Json::object();
  for (const auto& [name, flags] : plant.families) {
    families[name] = {{"loops", flags.loops}, {"flagged", flags.flagged}};
  }
  const bool tested = plant.untested < plant.plants * plant.loops;
  return {{"fault_share", plant.fault_share},
          {"plants", plant.plants},
          {"loops", plant.loops},
          {"faulty", plant.faulty},
          {"untested", plant.untested},
          {"flags", tested ? mean_json(plant.flags) : Json(nullptr)},
          {"false_share", tested ? mean_json(plant.false_share) : Json(nullptr)},
          {"found_share", tested ? mean_json(plant.found_share) : Json(nullptr)},
          {"families", std::move(families)}};
}

}  // namespace

nlohmann::ordered_json calibration_json(const Calibration& calibration) {
  Json plants = Json::array();
  for (const PlantSummary& plant : calibration.plants) plants.push_back(plant_json(plant));
  return {{"records", calibration.records}, {"levels", kLevels},
          {"tests", tests_json()},          {"families", families_json(calibration)},
          {"cost", cost_json(calibration)}, {"plants", std::move(plants)}};
}

}  // namespace loopscope::daemon
