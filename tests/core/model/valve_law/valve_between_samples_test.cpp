#include "core/model/valve_law/valve_between_samples.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/simulate/random.hpp"
#include "tests/core/model/valve_moves.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using Series = std::vector<double>;

using loopscope::tests::kNaN;

Valve valve_with(ValveLaw law, double lag, double stem_lag = 0.0, double resting_speed = 0.0) {
  return {law, 3.0, 1.0, 1.0, {lag, stem_lag, resting_speed}};
}

using tests::positions;
using tests::wandering_op;

Series ramp(double from, double by, std::size_t samples) {
  Series op(samples);
  for (std::size_t k = 0; k < samples; ++k) op[k] = from + by * static_cast<double>(k);
  return op;
}

/// He's stem under such a pressure, 20 looks a sample.
Series finer_he(double lag, const Series& op) {
  constexpr int kLooks = 20;
  const double share = 1.0 - std::exp(-1.0 / (kLooks * lag));
  double pressure = op.front();
  double place = pressure - 1.0;
  Series mv;
  for (const double target : op) {
    for (int i = 0; i < kLooks; ++i) {
      pressure += share * (target - pressure);
      const double gap = pressure - place;
      if (std::abs(gap) > 2.0) place = pressure - std::copysign(1.0, gap);
    }
    mv.push_back(place);
  }
  return mv;
}

double share_apart(const Series& left, const Series& right, double by) {
  std::size_t apart = 0;
  for (std::size_t k = 0; k < left.size(); ++k)
    apart += std::abs(left[k] - right[k]) > by ? 1U : 0U;
  return static_cast<double>(apart) / static_cast<double>(left.size());
}

TEST(ValveBetweenSamples, WithHardlyALagHeIsHeAtTheSamples) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Series op = wandering_op(seed);
    const Series sampled = positions({ValveLaw::he, 3.0, 1.0, 1.0}, op);
    EXPECT_LT(share_apart(positions(valve_with(ValveLaw::he, 0.005), op), sampled, 1e-3), 0.02);
  }
}

/// With a lag that makes up for fewer looks, as a search finds it.
TEST(ValveBetweenSamples, FollowsAFinerStemBetterThanALawOfTheSamples) {
  int followed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Series op = wandering_op(seed);
    const Series truth = finer_he(0.2, op);
    double between = 1.0;
    for (double lag = 0.1; lag < 0.6; lag *= 1.005) {
      const Series mv = positions(valve_with(ValveLaw::he, lag), op);
      between = std::min(between, share_apart(mv, truth, 0.3));
    }
    const double sampled = share_apart(positions({ValveLaw::he, 3.0, 1.0, 1.0}, op), truth, 0.3);
    followed += between < 0.5 * sampled ? 1 : 0;
  }
  EXPECT_GE(followed, 28);  // 32 when it was written
}

TEST(ValveBetweenSamples, HeGoesInSlipsOfJ) {
  const Series mv = positions(valve_with(ValveLaw::he, 0.1), ramp(50.0, 0.05, 400));
  int slips = 0;
  for (std::size_t k = 1; k < mv.size(); ++k) {
    const double move = mv[k] - mv[k - 1];
    if (move == 0.0) continue;
    EXPECT_NEAR(move, 1.0, 0.06);
    ++slips;
  }
  EXPECT_NEAR(slips, 19, 1);
}

TEST(ValveBetweenSamples, KanoMovesOnOnceItIsLoose) {
  const Series op = ramp(50.0, 0.05, 400);
  const Series mv = positions(valve_with(ValveLaw::kano, 0.1), op);
  EXPECT_EQ(mv[15], 49.0);
  for (std::size_t k = 30; k < mv.size(); ++k) EXPECT_NEAR(mv[k], op[k] - 1.0, 0.01) << k;
}

TEST(ValveBetweenSamples, AMovingStemFollowsWithItsLag) {
  const Series op = ramp(50.0, 0.05, 400);
  const Series fast = positions(valve_with(ValveLaw::kano, 0.1), op);
  const Series slow = positions(valve_with(ValveLaw::kano, 0.1, 0.5), op);
  // op is held for a sample, and the stem makes 1 - exp(-2) of its way meanwhile.
  EXPECT_NEAR(fast.back() - slow.back(), 0.05 / std::expm1(2.0), 0.002);
}

TEST(ValveBetweenSamples, AStemThatIsTooSlowRests) {
  const Series mv = positions(valve_with(ValveLaw::kano, 0.1, 0.0, 1.0), ramp(50.0, 0.05, 400));
  std::size_t stands = 0;
  for (std::size_t k = 1; k < mv.size(); ++k) stands += mv[k] == mv[k - 1] ? 1U : 0U;
  EXPECT_GT(stands, 300U);
}

/// However long op stands still meanwhile.
TEST(ValveBetweenSamples, AStemThatNoSpeedIsTooSlowForMovesOnUntilThePressureTurnsBack) {
  Series op(5, 50.0);
  op.insert(op.end(), 200, 53.0);
  op.insert(op.end(), 5, 53.1);
  op.insert(op.end(), 5, 53.0);
  op.insert(op.end(), 5, 53.1);
  const Series mv = positions(valve_with(ValveLaw::kano, 0.1, 0.1), op);
  EXPECT_NEAR(mv[204], 52.0, 1e-9);
  EXPECT_NEAR(mv[209], 52.1, 1e-9);
  EXPECT_EQ(mv[214], mv[209]);
  EXPECT_EQ(mv[219], mv[209]);
}

TEST(ValveBetweenSamples, RestsWithinItsBand) {
  Series op = wandering_op(3);
  for (double& value : op) value = 50.0 + 0.9 * std::sin(value);
  for (const ValveLaw law : {ValveLaw::he, ValveLaw::kano}) {
    const Series mv = positions(valve_with(law, 0.2), op);
    EXPECT_EQ(std::ranges::min(mv), std::ranges::max(mv));
  }
}

TEST(ValveBetweenSamples, StandsWhereOpIsMissing) {
  const Series mv = positions(valve_with(ValveLaw::he, 0.1), {kNaN, 50.0, 55.0, kNaN, kNaN, 55.0});
  EXPECT_TRUE(std::isnan(mv[0]));
  EXPECT_EQ(mv[1], 49.0);
  EXPECT_GT(mv[2], 52.9);
  EXPECT_EQ(mv[3], mv[2]);
  EXPECT_EQ(mv[4], mv[2]);
}

TEST(ValveBetweenSamples, AStemMayBeginElsewhere) {
  Valve valve = valve_with(ValveLaw::he, 0.1);
  valve.start_percent = 51.5;
  EXPECT_EQ(positions(valve, Series(3, 50.0)), (Series{51.5, 51.5, 51.5}));
}

}  // namespace
}  // namespace loopscope::core::model
