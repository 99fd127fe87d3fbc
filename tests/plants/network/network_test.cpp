#include "tests/plants/network/network.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::tests::network {
namespace {

/// One of the few seeds whose first draft is shaken: the test need not wait for more.
constexpr std::uint64_t kSeed = 1;

TEST(Network, IsTheSameForTheSameSeed) {
  const Draft draft = draw_plan(kSeed, Origin::valve, LoopKind::flow);
  const auto one = simulate(draft.with, 256);
  const auto other = simulate(draw_plan(kSeed, Origin::valve, LoopKind::flow).with, 256);
  ASSERT_EQ(one.size(), 30U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].pv, other[i].pv);
    EXPECT_EQ(one[i].op, other[i].op);
  }
}

TEST(Network, DraftsHaveTheLoopsAndTheCauseThatTheyPromise) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Draft valve = draw_plan(seed, Origin::valve, LoopKind::level);
    ASSERT_EQ(valve.with.loops.size(), 30U);
    ASSERT_TRUE(valve.source.has_value());
    EXPECT_EQ(valve.with.loops[*valve.source].kind, LoopKind::level);
    EXPECT_FALSE(valve.with.loops[*valve.source].master.has_value());
    EXPECT_GE(std::ranges::count_if(valve.with.loops,
                                    [](const LoopPlan& loop) { return loop.master.has_value(); }),
              1);
    const Draft outside = draw_plan(seed, Origin::outside, LoopKind::flow);
    EXPECT_FALSE(outside.source.has_value());
    EXPECT_GT(outside.with.outside.amplitude, 0.0);
    EXPECT_EQ(outside.without.outside.amplitude, 0.0);
    const Draft recycle = draw_plan(seed, Origin::recycle, LoopKind::flow);
    ASSERT_TRUE(recycle.source.has_value());
    EXPECT_EQ(recycle.with.loops[*recycle.source].unit, 4U);
  }
}

TEST(Network, SamplesLieOnTheBeatOfTheirScanClass) {
  const Draft draft = draw_plan(kSeed, Origin::valve, LoopKind::flow);
  for (const LoopRecord& record : simulate(draft.with, 256)) {
    EXPECT_EQ(record.pv.size(), 256U);
    EXPECT_NEAR(std::remainder(record.start_s, record.interval_s), 0.0, 1e-6);
  }
}

TEST(Network, AMastersOutputIsItsSlavesSetpoint) {
  const Draft draft = draw_plan(kSeed, Origin::valve, LoopKind::flow);
  const auto records = simulate(draft.with, 256);
  ASSERT_FALSE(records.empty());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto& master = draft.with.loops[i].master;
    if (!master || records[i].interval_s != records[*master].interval_s ||
        draft.with.loops[i].controller.scan_s != 1.0)
      continue;
    const double late = (records[i].start_s - records[*master].start_s) / records[i].interval_s;
    for (std::size_t k = 0; static_cast<double>(k) + std::abs(late) < 256.0; ++k) {
      const std::size_t own = late < 0.0 ? k + static_cast<std::size_t>(-late) : k;
      const std::size_t told = late < 0.0 ? k : k + static_cast<std::size_t>(late);
      EXPECT_NEAR(records[i].sp[own] - 50.0,
                  draft.with.loops[i].master_gain * (records[*master].op[told] - 50.0), 1e-9);
    }
  }
}

TEST(Network, APlantIsShakenByItsCause) {
  const NetworkPlant plant = draw_network(kSeed, Origin::valve);
  ASSERT_TRUE(plant.source.has_value());
  EXPECT_TRUE(plant.loops[*plant.source].carries);
  EXPECT_GE(std::ranges::count_if(plant.loops, &TrueLoop::carries), 4);
  EXPECT_GT(plant.period_s, 0.0);
  for (const LoopRecord& record : plant.records) EXPECT_EQ(record.pv.size(), kSamples);
}

}  // namespace
}  // namespace loopscope::tests::network
