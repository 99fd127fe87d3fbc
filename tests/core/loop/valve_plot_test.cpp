#include "core/loop/valve_plot.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;

Series swinging_op(Random& random) {
  Series op = signals::wave(random, 4096, signals::Wave::sine, 120.0, 0.1);
  for (double& v : op) v = 50.0 + 6.0 * v;
  return op;
}

TEST(ValvePlot, DeadBandIsItsWidth) {
  for (const double width : {0.5, 2.0, 5.0}) {
    Random random(1);
    const Series op = swinging_op(random);
    const ValvePlot plot = measure_valve_plot(op, signals::through_valve(op, width, 0.0));
    ASSERT_TRUE(plot.width);
    EXPECT_NEAR(*plot.width, width, 0.05 * width);
  }
}

TEST(ValvePlot, StickingValveShowsStickbandLessSlipJump) {
  Random random(2);
  const Series op = swinging_op(random);
  const ValvePlot plot = measure_valve_plot(op, signals::through_valve(op, 3.0, 1.0));
  ASSERT_TRUE(plot.width);
  EXPECT_NEAR(*plot.width, 2.0, 0.1);
  EXPECT_GT(*plot.stuck_fraction, 0.5);
}

TEST(ValvePlot, AValveThatOnlyJumpsHasAWidthToo) {
  std::vector<double> op;
  std::vector<double> mv;
  for (int k = 0; k < 1000; ++k) {
    const double phase = k % 100;
    op.push_back(phase < 50 ? 48.0 + 0.08 * phase : 52.0 - 0.08 * (phase - 50));
    // Jumps to 51 at op = 51.5 and to 49 at 48.5: the branches lie one percent apart.
    mv.push_back(mv.empty()          ? 49.0
                 : op.back() >= 51.5 ? 51.0
                 : op.back() <= 48.5 ? 49.0
                                     : mv.back());
  }
  const ValvePlot plot = measure_valve_plot(op, mv);
  EXPECT_NEAR(*plot.width, 1.0, 0.1);
  EXPECT_GT(*plot.stuck_fraction, 0.9);
}

TEST(ValvePlot, HealthyValveHasNoWidthAndIsNeverStuck) {
  Random random(3);
  const Series op = swinging_op(random);
  const ValvePlot plot = measure_valve_plot(op, op);
  EXPECT_NEAR(*plot.width, 0.0, 1e-9);
  EXPECT_NEAR(*plot.stuck_fraction, 0.0, 1e-9);
}

TEST(ValvePlot, PositionNoiseDoesNotHideTheBand) {
  Random random(4);
  const Series op = swinging_op(random);
  const Series mv =
      signals::sum(signals::through_valve(op, 2.0, 0.0), signals::white(random, op.size()), 0.02);
  EXPECT_NEAR(*measure_valve_plot(op, mv).width, 2.0, 0.1);
}

/// op of a controller that answers noise, in which a lag is as wide as a dead band.
Series restless_op(Random& random) {
  Series op = swinging_op(random);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (double& v : op) v += noise(random);
  return op;
}

Series behind_lag(const Series& op, double lag_samples) {
  const double pole = std::exp(-1.0 / lag_samples);
  Series out;
  double state = op.front();
  for (const double v : op) out.push_back(state = pole * state + (1.0 - pole) * v);
  return out;
}

TEST(ValvePlot, ALagIsNoBand) {
  for (const double lag_samples : {0.3, 0.45, 1.0, 2.4, 5.0}) {
    Random random(7);
    const Series op = restless_op(random);
    const Series position = behind_lag(op, lag_samples);
    const ValvePlot plot =
        measure_valve_plot(op, signals::sum(position, signals::white(random, op.size()), 0.01));
    EXPECT_LT(*plot.width, 0.1) << lag_samples;
    EXPECT_LT(*plot.slip_jump, 0.1) << lag_samples;
  }
}

TEST(ValvePlot, BandAndJumpAreSeenBehindALag) {
  for (const double lag_samples : {0.5, 1.2, 3.0}) {
    Random random(8);
    const Series op = restless_op(random);
    const Series input = behind_lag(op, lag_samples);
    EXPECT_NEAR(*measure_valve_plot(op, signals::through_valve(input, 2.0, 0.0)).width, 2.0, 0.1);
    const ValvePlot sticks = measure_valve_plot(op, signals::through_valve(input, 3.0, 1.5));
    EXPECT_NEAR(*sticks.width, 1.5, 0.2) << lag_samples;
    EXPECT_GT(*sticks.slip_jump, 0.2 * (*sticks.slip_jump + *sticks.width)) << lag_samples;
  }
}

/// Else every sample's noise is a move, of a branch of its own.
TEST(ValvePlot, NoiseOfAValveThatRestsIsNoMove) {
  Random random(9);
  Series op = restless_op(random);
  for (double& v : op) v = 50.0 + 0.3 * (v - 50.0);
  const Series mv =
      signals::sum(signals::through_valve(op, 2.0, 0.0), signals::white(random, op.size()), 0.02);
  EXPECT_NEAR(*measure_valve_plot(op, mv).width, 2.0, 0.2);
}

TEST(ValvePlot, GapsAreSkipped) {
  Random random(5);
  const Series op = swinging_op(random);
  const Series mv = signals::with_missing(random, signals::through_valve(op, 2.0, 0.0), 0.2);
  EXPECT_NEAR(*measure_valve_plot(op, mv).width, 2.0, 0.1);
}

TEST(ValvePlot, StuckFractionCountsOnlySamplesInWhichOpMoves) {
  const Series op{1.0, 2.0, 3.0, 3.0, 3.0, 4.0, 5.0}, mv{0.0, 0.0, 3.0, 3.0, 3.0, 3.0, 5.0};
  EXPECT_DOUBLE_EQ(*measure_valve_plot(op, mv).stuck_fraction, 0.5);
}

TEST(ValvePlot, ConstantOrMissingGivesNothing) {
  Random random(6);
  const Series op = swinging_op(random);
  for (const Series& mv : {Series{}, Series(op.size(), 50.0), Series(op.size(), std::nan(""))}) {
    const ValvePlot plot = measure_valve_plot(op, mv);
    EXPECT_FALSE(plot.width || plot.stuck_fraction);
  }
}

}  // namespace
}  // namespace loopscope::core::loop
