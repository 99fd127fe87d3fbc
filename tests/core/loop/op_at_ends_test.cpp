#include "core/loop/op_at_ends.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::loop {
namespace {

/// A wave of 40 samples, held at `limit`.
std::vector<double> held_wave(double limit) {
  std::vector<double> op(400);
  for (std::size_t k = 0; k < op.size(); ++k)
    op[k] = std::min(limit, 50.0 + 10.0 * std::sin(0.157079632679 * static_cast<double>(k) + 0.05));
  return op;
}

TEST(OpAtEnds, ALimitIsMetInEveryCycle) {
  const auto rest = measure_op_at_ends(held_wave(55.0));
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->share, 1.0 / 3.0, 0.05);
  EXPECT_EQ(rest->visits, 10.0);
}

TEST(OpAtEnds, AWaveThatTurnsRestsNowhere) {
  const auto rest = measure_op_at_ends(held_wave(100.0));
  ASSERT_TRUE(rest);
  EXPECT_LT(rest->share, 0.02);
}

TEST(OpAtEnds, OneLongRestIsOneVisit) {
  std::vector<double> op = held_wave(100.0);
  std::fill(op.begin() + 100, op.begin() + 200, 61.0);
  EXPECT_EQ(measure_op_at_ends(op)->visits, 1.0);
  EXPECT_EQ(measure_op_at_ends(op)->share, 0.0) << "and no limit";
}

/// A wave in whole units, about six samples at each where it passes.
std::vector<double> coarse_wave(double limit) {
  std::vector<double> op(4000);
  for (std::size_t k = 0; k < op.size(); ++k)
    op[k] = std::min(limit,
                     std::round(50.0 + 12.4 * std::sin(0.0157079632679 * static_cast<double>(k))));
  return op;
}

TEST(OpAtEnds, TheLimitOfACoarseWaveIsMet) {
  EXPECT_GT(measure_op_at_ends(coarse_wave(50.0))->share, 0.5);
  EXPECT_LT(measure_op_at_ends(coarse_wave(100.0))->share, 0.3) << "a sine stays where it turns";
}

/// Of 60 wandering outputs (an autoregression of standard deviation 1 in steps, held) those that
/// rest at an end for more than 2 % of the time.
std::size_t resting_of_60(double memory, double step, std::size_t hold) {
  std::size_t resting = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> op(4096);
    double level = 0.0;
    for (std::size_t k = 0; k < op.size(); ++k) {
      level = memory * level + std::sqrt(1.0 - memory * memory) * normal(random);
      op[k] = k % hold == 0 ? std::round(level / step) * step : op[k - 1];
    }
    const auto rest = measure_op_at_ends(op);
    resting += rest && rest->share > 0.02 ? 1U : 0U;
  }
  return resting;
}

TEST(OpAtEnds, ACoarseOrHeldOutputHasNoLimit) {
  // By the length of the rests alone 44, 32 and 60 of the first three.
  EXPECT_LE(resting_of_60(0.98, 2.0, 1), 1U);
  EXPECT_LE(resting_of_60(0.95, 1.5, 4), 1U);
  EXPECT_LE(resting_of_60(0.98, 3.0, 1), 1U);
  EXPECT_LE(resting_of_60(0.998, 1.0, 1), 1U);
  EXPECT_LE(resting_of_60(0.999, 0.5, 4), 1U);
}

TEST(OpAtEnds, AFewValuesTellNothing) {
  std::vector<double> op(4000);
  for (std::size_t k = 0; k < op.size(); ++k)
    op[k] = 50.0 + std::round(1.4 * std::sin(0.01 * static_cast<double>(k)));
  EXPECT_FALSE(measure_op_at_ends(op));
  for (std::size_t k = 0; k < op.size(); ++k) op[k] = (k / 50) % 2 == 0 ? 0.0 : 100.0;
  EXPECT_FALSE(measure_op_at_ends(op)) << "whoever knows the range can say more";
}

TEST(OpAtEnds, WhatStandsStillOrIsShortIsNone) {
  EXPECT_FALSE(measure_op_at_ends(std::vector<double>(100, 1.0)));
  EXPECT_FALSE(measure_op_at_ends(std::vector<double>{1.0, 2.0}));
  EXPECT_FALSE(measure_op_at_ends(std::vector<double>(100, signal::kMissing)));
  EXPECT_FALSE(measure_op_at_ends({}));
}

}  // namespace
}  // namespace loopscope::core::loop
