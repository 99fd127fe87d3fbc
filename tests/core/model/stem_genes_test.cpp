#include "core/model/stem_genes.hpp"

#include <gtest/gtest.h>
#include <set>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

TEST(StemGenes, GuessesFillTheirRanges) {
  std::set<int> bands, jumps, starts;
  for (std::size_t i = 0; i < 1000; ++i) {
    const StemGenes genes = drawn_genes(ValveLaw::kano, 2.0, i);
    ASSERT_GE(genes.band, 1.4);
    ASSERT_LE(genes.band, 2.8);
    ASSERT_GT(genes.between.actuator_lag_samples, 0.0);
    bands.insert(static_cast<int>((genes.band - 1.4) / 0.141));
    jumps.insert(static_cast<int>((genes.jump_share - 0.2) / 0.0801));
    starts.insert(static_cast<int>((genes.behind_op + 1.0) / 0.201));
  }
  EXPECT_EQ(bands.size(), 10U);
  EXPECT_EQ(jumps.size(), 10U);
  EXPECT_EQ(starts.size(), 10U);
}

TEST(StemGenes, HeHasNeitherStemLagNorRestingSpeed) {
  const StemGenes genes = varied(drawn_genes(ValveLaw::he, 2.0, 8), 1.0, 3);
  EXPECT_EQ(genes.between.stem_lag_samples, 0.0);
  EXPECT_EQ(genes.between.resting_speed, 0.0);
}

TEST(StemGenes, AChildOfNoScaleIsItsParent) {
  const StemGenes parent = drawn_genes(ValveLaw::kano, 2.0, 6);
  const StemGenes child = varied(parent, 0.0, 17);
  EXPECT_EQ(child.band, parent.band);
  EXPECT_EQ(child.jump_share, parent.jump_share);
  EXPECT_EQ(child.behind_op, parent.behind_op);
  EXPECT_EQ(child.later_samples, parent.later_samples);
  EXPECT_EQ(child.slowness, parent.slowness);
}

TEST(StemGenes, BecomeAValveThatStandsWithinItsBand) {
  for (std::size_t i = 0; i < 200; ++i) {
    StemGenes genes = varied(drawn_genes(ValveLaw::he, 3.0, i), 3.0, i);
    const Valve valve = valve_of(genes, ValveLaw::he, 1.5).valve();
    EXPECT_GE(valve.slip_jump_percent, 0.0);
    EXPECT_LE(valve.slip_jump_percent, valve.stickband_percent);
    EXPECT_FALSE(valve.acts_at_samples());
  }
}

TEST(StemGenes, BecomeAStableProcessWithDelay) {
  for (std::size_t i = 0; i < 200; ++i) {
    StemGenes genes = varied(drawn_genes(ValveLaw::he, 3.0, i), 5.0, i);
    const ProcessShape lag = process_of(genes, tests::two_lags(0.99, 0.9, 1));
    EXPECT_LE(lag.pole, 0.999);
    EXPECT_LE(lag.second_pole, 0.995);
    EXPECT_GE(lag.delay_samples, 1U);
    const ProcessShape vessel = process_of(genes, tests::integrator(4));
    EXPECT_TRUE(vessel.integrating);
    EXPECT_EQ(vessel.pole, 1.0);
  }
}

}  // namespace
}  // namespace loopscope::core::model
