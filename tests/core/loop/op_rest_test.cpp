#include "core/loop/op_rest.hpp"

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

TEST(OpRest, ALimitIsMetInEveryCycle) {
  const auto rest = measure_op_rest(held_wave(55.0));
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->share, 1.0 / 3.0, 0.05);
  EXPECT_EQ(rest->visits, 10.0);
}

TEST(OpRest, AWaveThatTurnsRestsNowhere) {
  const auto rest = measure_op_rest(held_wave(100.0));
  ASSERT_TRUE(rest);
  EXPECT_LT(rest->share, 0.02);
}

TEST(OpRest, OneLongRestIsOneVisit) {
  std::vector<double> op = held_wave(100.0);
  std::fill(op.begin() + 100, op.begin() + 200, 61.0);
  EXPECT_EQ(measure_op_rest(op)->visits, 1.0);
  EXPECT_EQ(measure_op_rest(op)->share, 0.0) << "and no limit";
}

TEST(OpRest, ACoarseOpRestsNowhereAndItsLimitIsMet) {
  // 25 values, each for about six samples where the wave passes.
  const auto coarse_wave = [](double limit) {
    std::vector<double> op(4000);
    for (std::size_t k = 0; k < op.size(); ++k)
      op[k] = std::min(
          limit, std::round(50.0 + 12.4 * std::sin(0.0157079632679 * static_cast<double>(k))));
    return op;
  };
  EXPECT_LT(measure_op_rest(coarse_wave(100.0))->share, 0.35) << "a sine stays where it turns";
  EXPECT_GT(measure_op_rest(coarse_wave(50.0))->share, 0.4);
}

TEST(OpRest, ACoarseWanderingOpHasNoLimit) {
  // AR(1) in whole percent, and the same held for four samples: 20 records each.
  for (const std::size_t hold : {1U, 4U}) {
    std::size_t with_limit = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::mt19937 random(seed);
      std::normal_distribution<double> normal;
      std::vector<double> op(4096);
      double level = 0.0;
      for (std::size_t k = 0; k < op.size(); ++k) {
        level = 0.98 * level + normal(random) * 0.4;
        op[k] = k % hold == 0 ? std::round(50.0 + level) : op[k - 1];
      }
      with_limit += measure_op_rest(op)->share > 0.02 ? 1U : 0U;
    }
    EXPECT_LE(with_limit, 1U) << "held for " << hold;
  }
}

TEST(OpRest, WhatStandsStillOrIsShortIsNone) {
  EXPECT_FALSE(measure_op_rest(std::vector<double>(100, 1.0)));
  EXPECT_FALSE(measure_op_rest(std::vector<double>{1.0, 2.0}));
  EXPECT_FALSE(measure_op_rest(std::vector<double>(100, signal::kMissing)));
  EXPECT_FALSE(measure_op_rest({}));
}

}  // namespace
}  // namespace loopscope::core::loop
