#include "tests/plants/repair.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "tests/plants/repair_fault.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::tests::repairs {
namespace {

std::uint64_t last_seed() {
  return records(10);
}

TEST(Repair, SameSeedSameRepair) {
  const Repair one = draw_repair(Word::improved, 3);
  const Repair other = draw_repair(Word::improved, 3);
  EXPECT_EQ(one.fault, other.fault);
  ASSERT_EQ(one.before.size(), other.before.size());
  EXPECT_EQ(one.before.front().pv, other.before.front().pv);
  EXPECT_EQ(one.after.back().op, other.after.back().op);
}

TEST(Repair, HasOneToFourWindowsOfItsOwnOnEachSide) {
  for (std::uint64_t seed = 1; seed <= last_seed(); ++seed) {
    const Repair repair = draw_repair(Word::unchanged, seed);
    std::set<std::vector<double>> records;
    for (const auto* side : {&repair.before, &repair.after}) {
      EXPECT_GE(side->size(), 1u);
      EXPECT_LE(side->size(), 4u);
      for (const effects::Series& window : *side) {
        EXPECT_EQ(window.pv.size(), effects::kSamples);
        EXPECT_TRUE(records.insert(window.pv).second);
      }
    }
  }
}

/// What the words mean: the cost of the fault in the long run, under the same load and noise.
TEST(Repair, WordsHoldOfTheLongRun) {
  for (std::uint64_t seed = 1; seed <= last_seed(); ++seed) {
    EXPECT_DOUBLE_EQ(draw_repair(Word::unchanged, seed).variance_ratio, 1.0);
    // A fault that leaves the variance alone (the sensor's, a bent valve) may be smaller or larger.
    EXPECT_LT(draw_repair(Word::improved, seed).variance_ratio, 1.2) << seed;
    EXPECT_GT(draw_repair(Word::worse, seed).variance_ratio, 0.8) << seed;
  }
}

TEST(RepairFault, GrowsWithItsSize) {
  effects::Random random(1);
  for (const FaultKind& kind : fault_kinds()) {
    const effects::Draft loop = effects::draw_loop(kind.options, random);
    const PutFault put = kind.draw(loop, random);
    effects::Scenario small = loop.base;
    effects::Scenario large = loop.base;
    small.sp = large.sp = loop.scenario.sp;
    put(small, 0.0);
    put(large, 1.0);
    const std::vector<double> sound = effects::simulate(loop.scenario).pv;
    const auto distance = [&](const effects::Scenario& faulty) {
      const std::vector<double> pv = effects::simulate(faulty).pv;
      double sum = 0.0;
      for (std::size_t k = 0; k < pv.size(); ++k) sum += std::pow(pv[k] - sound[k], 2);
      return sum;
    };
    EXPECT_GT(distance(large), distance(small)) << kind.name;
    EXPECT_GT(distance(small), 0.0) << kind.name;
  }
}

}  // namespace
}  // namespace loopscope::tests::repairs
