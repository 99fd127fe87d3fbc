#include "tests/plants/plant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <stdexcept>

#include "tests/plants/fault_kinds.hpp"

namespace loopscope::tests::plants {
namespace {

std::map<std::string, int> faults_of(const std::vector<PlantLoop>& plant) {
  std::map<std::string, int> count;
  for (const PlantLoop& loop : plant)
    if (loop.is_faulty()) ++count[loop.fault];
  return count;
}

TEST(Plant, Has500LoopsAnd25FaultsOf8Kinds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<PlantLoop> plant = draw_plant(seed);
    ASSERT_EQ(plant.size(), 500U);
    int faulty = 0;
    for (const auto& [fault, count] : faults_of(plant)) {
      EXPECT_GE(count, 3) << fault;
      EXPECT_LE(count, 4) << fault;
      faulty += count;
    }
    EXPECT_EQ(faulty, 25);
    EXPECT_EQ(faults_of(plant).size(), 8U);
  }
}

TEST(Plant, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto names_of_faults = [](std::uint64_t seed) {
    std::set<std::string> names;
    for (const PlantLoop& loop : draw_plant(seed))
      if (loop.is_faulty()) names.insert(loop.name + loop.record + std::to_string(loop.seed));
    return names;
  };
  EXPECT_EQ(names_of_faults(3), names_of_faults(3));
  EXPECT_NE(names_of_faults(3), names_of_faults(4));
}

TEST(Plant, LoopsAreAllDifferent) {
  std::set<std::string> names;
  std::set<std::uint64_t> seeds;
  for (const PlantLoop& loop : draw_plant(7)) {
    names.insert(loop.name);
    seeds.insert(loop.seed);
    EXPECT_GT(loop.importance, 0.0);
  }
  EXPECT_EQ(names.size(), 500U);
  EXPECT_EQ(seeds.size(), 500U);
}

TEST(Plant, EveryFaultIsRightForItsRecords) {
  std::map<std::string, std::vector<std::string>> right;
  for (const effects::KindInfo& kind : effects::all_kinds()) right[kind.name] = kind.verdicts;
  for (const FaultKind& kind : fault_kinds())
    for (const std::string_view record : kind.records)
      EXPECT_THAT(right[std::string(record)], testing::Contains(std::string(kind.verdict)));
}

TEST(Plant, AnotherStretchIsTheSameLoopUnderOtherNoise) {
  const PlantLoop loop = draw_plant(2, {1, 0}).front();
  const effects::Record now = record_of(loop);
  const effects::Record before = record_of(loop, 1);
  EXPECT_EQ(now.pv, record_of(loop).pv);
  EXPECT_NE(now.pv, before.pv);
  EXPECT_EQ(now.sp, before.sp);
  EXPECT_EQ(now.truth.loop.gain, before.truth.loop.gain);
}

TEST(Plant, VesselsAreLevels) {
  int levels = 0;
  for (const PlantLoop& loop : draw_plant(5, {40, 0})) {
    const effects::Record record = record_of(loop);
    const bool level = loop_type(loop, record) == "level";
    EXPECT_EQ(level, record.truth.loop.integrating);
    levels += level ? 1 : 0;
  }
  EXPECT_GT(levels, 0);
  EXPECT_LT(levels, 40);
}

TEST(Plant, MoreFaultsThanLoopsAreRefused) {
  EXPECT_THROW(static_cast<void>(draw_plant(1, {3, 4})), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::tests::plants
