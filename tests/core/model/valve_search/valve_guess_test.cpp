#include "core/model/valve_search/valve_guess.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

double band_of(const ValveGuess& genes) {
  return std::exp(genes[Gene::log_band]);
}

TEST(ValveGuess, GuessesFillTheirRanges) {
  std::set<int> bands, jumps, starts, seconds;
  for (std::size_t i = 0; i < 1000; ++i) {
    const ValveGuess genes = drawn_genes(2.0, i);
    ASSERT_GE(band_of(genes), 1.4 - 1e-9);
    ASSERT_LE(band_of(genes), 2.8 + 1e-9);
    bands.insert(static_cast<int>((band_of(genes) - 1.4) / 0.141));
    jumps.insert(static_cast<int>((genes[Gene::jump_share] - 0.2) / 0.0801));
    starts.insert(static_cast<int>((genes[Gene::behind_op] + 1.0) / 0.201));
    seconds.insert(static_cast<int>((genes[Gene::second_share] + 0.2) / 0.0801));
  }
  EXPECT_EQ(bands.size(), 10U);
  EXPECT_EQ(jumps.size(), 10U);
  EXPECT_EQ(starts.size(), 10U);
  EXPECT_EQ(seconds.size(), 10U);
}

TEST(ValveGuess, HeHasNeitherStemLagNorRestingSpeed) {
  const BetweenSamples between = valve_of(drawn_genes(2.0, 8), ValveLaw::he, 0.0).valve().between;
  EXPECT_EQ(between.stem_lag_samples, 0.0);
  EXPECT_EQ(between.resting_speed, 0.0);
}

TEST(ValveGuess, HalfOfTheFirstGuessesHaveNoSpeedTooSlow) {
  int none = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const Valve valve = valve_of(drawn_genes(2.0, i), ValveLaw::kano, 0.0).valve();
    none += valve.between.resting_speed == 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(none, 500, 20);
}

TEST(ValveGuess, AChildOfNoScaleAndNoWayIsItsParent) {
  const ValveGuess parent = drawn_genes(2.0, 6), other = drawn_genes(2.0, 7);
  EXPECT_EQ(varied(parent, {parent, other, 0.0}, 0.0, 17).at, parent.at);
}

TEST(ValveGuess, AChildGoesThatShareOfTheWay) {
  const ValveGuess parent = drawn_genes(2.0, 6), from = drawn_genes(2.0, 7);
  ValveGuess to = from;
  to.at[static_cast<std::size_t>(Gene::log_slowness)] += 0.4;
  const ValveGuess child = varied(parent, {from, to, 0.5}, 0.0, 17);
  EXPECT_NEAR(child[Gene::log_slowness], parent[Gene::log_slowness] + 0.2, 1e-12);
  EXPECT_EQ(child[Gene::log_band], parent[Gene::log_band]);
}

TEST(ValveGuess, BecomeAValveThatStandsWithinItsBand) {
  for (std::size_t i = 0; i < 200; ++i) {
    const ValveGuess parent = drawn_genes(3.0, i);
    const ValveGuess from = drawn_genes(3.0, i + 7), to = drawn_genes(3.0, i + 9);
    const Valve valve =
        valve_of(varied(parent, {from, to, 0.7}, 3.0, i), ValveLaw::he, 1.5).valve();
    EXPECT_GE(valve.slip_jump_percent, 0.0);
    EXPECT_LE(valve.slip_jump_percent, valve.stickband_percent);
    EXPECT_FALSE(valve.acts_at_samples());
  }
}

TEST(ValveGuess, BecomeAStableProcessWithDelay) {
  for (std::size_t i = 0; i < 200; ++i) {
    const ValveGuess parent = drawn_genes(3.0, i);
    const ValveGuess genes = varied(parent, {parent, parent, 0.0}, 5.0, i);
    const ProcessShape lag = process_of(genes, tests::two_lags(0.99, 0.9, 1));
    EXPECT_LE(lag.pole, 0.999);
    EXPECT_LE(lag.second_pole, 0.995);
    EXPECT_GE(lag.delay_samples, 1U);
    const ProcessShape vessel = process_of(genes, tests::integrator(4));
    EXPECT_TRUE(vessel.integrating);
    EXPECT_EQ(vessel.pole, 1.0);
  }
}

TEST(ValveGuess, AQuarterOfTheFirstGuessesHaveNoSecondLag) {
  int none = 0;
  for (std::size_t i = 0; i < 1000; ++i)
    none += process_of(drawn_genes(2.0, i), tests::one_lag(0.8, 10)).second_pole == 0.0 ? 1 : 0;
  EXPECT_NEAR(none, 250, 20);
}

/// Dead time and second lag together are what op's answer shows: their sum is kept.
TEST(ValveGuess, ASecondLagTakesItsTimeFromTheDeadTime) {
  ValveGuess genes;
  genes.at[static_cast<std::size_t>(Gene::second_share)] = 0.5;
  const ProcessShape shape = process_of(genes, tests::one_lag(0.8, 10));
  EXPECT_EQ(shape.delay_samples, 5U);
  EXPECT_NEAR(shape.second_pole, std::exp(-1.0 / 5.0), 1e-12);
}

}  // namespace
}  // namespace loopscope::core::model
