#include "core/model/limit_cycle/slow_travel.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>

#include "core/simulate/random.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kStrokeSamples = 800;

/// Three strokes of 2 % in noise of 0.1: pv follows op, or the valve that sticks over `band` of it,
/// behind a lag.
struct Strokes {
  std::vector<double> op, pv;
};

Strokes strokes(double band, double lag_samples, std::uint64_t seed) {
  simulate::GaussianSource noise(seed);
  Strokes result;
  for (std::size_t k = 0; k < kStrokeSamples; ++k) {
    const double turn = 3.0 * std::numbers::pi * static_cast<double>(k) / kStrokeSamples;
    result.op.push_back(25.0 + std::asin(std::sin(turn)) * 2.0 / std::numbers::pi);
  }
  result.pv.resize(kStrokeSamples);
  run_valve({ValveLaw::kano, band, 0.3 * band, 1.0}, result.op, result.pv);
  double level = result.pv.front();
  for (double& value : result.pv) {
    level += (value - level) / (1.0 + lag_samples);
    value = 4.0 * level + 0.1 * noise.next();
  }
  return result;
}

int found(double band, double lag_samples = 0.0) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Strokes records = strokes(band, lag_samples, seed);
    const auto travel = judge_slow_travel(records.pv, records.op);
    count += travel && travel->sticks() ? 1 : 0;
  }
  std::printf("| band %.1f %%, lag %.0f | sticks in %d of 20 |\n", band, lag_samples, count);
  return count;
}

TEST(SlowTravel, AValveThatRestsOverMostOfTheTravelIsFound) {
  EXPECT_GE(found(1.4), 19);
}

TEST(SlowTravel, OneThatFollowsIsNot) {
  EXPECT_LE(found(0.0), 1);
}

TEST(SlowTravel, ASlowProcessIsNoValveThatComesLate) {
  EXPECT_LE(found(0.0, 60.0), 1);
  EXPECT_LE(found(0.0, 150.0), 1);
  EXPECT_LE(found(0.0, 500.0), 1);
}

TEST(SlowTravel, TheBandIsTheValves) {
  const Strokes records = strokes(1.4, 0.0, 3);
  const auto travel = judge_slow_travel(records.pv, records.op);
  ASSERT_TRUE(travel);
  EXPECT_NEAR(travel->valve.stickband_percent, 1.4, 0.2);
  EXPECT_LT(travel->error_after(), travel->error_before());
}

/// Mean squares of what the two leave of the means of pv.
TEST(SlowTravel, TheModelsThatWereComparedCanBeRun) {
  const Strokes records = strokes(1.4, 0.0, 3);
  const auto travel = judge_slow_travel(records.pv, records.op);
  ASSERT_TRUE(travel);
  const SimulatedTravel simulated = simulate_travel(*travel, records.op);
  ASSERT_EQ(simulated.linear.size(), kStrokeSamples / kTravelMean);
  ASSERT_EQ(simulated.valve.size(), simulated.linear.size());
  double linear = 0.0, valve = 0.0;
  for (std::size_t i = 0; i < simulated.linear.size(); ++i) {
    double mean = 0.0;
    for (std::size_t k = 0; k < kTravelMean; ++k) mean += records.pv[i * kTravelMean + k];
    mean /= static_cast<double>(kTravelMean);
    linear += std::pow(mean - simulated.linear[i], 2);
    valve += std::pow(mean - simulated.valve[i], 2);
  }
  const auto means = static_cast<double>(simulated.linear.size());
  EXPECT_NEAR(linear / means / travel->error_before(), 1.0, 0.2);
  EXPECT_NEAR(valve / means / travel->error_after(), 1.0, 0.2);
}

TEST(SlowTravel, NothingToJudge) {
  const std::vector<double> still(kStrokeSamples, 1.0);
  const Strokes records = strokes(1.0, 0.0, 1);
  EXPECT_FALSE(judge_slow_travel(still, records.op));
  EXPECT_FALSE(judge_slow_travel(records.pv, still));
  EXPECT_FALSE(
      judge_slow_travel(std::span(records.pv).first(200), std::span(records.op).first(200)));
}

}  // namespace
}  // namespace loopscope::core::model
