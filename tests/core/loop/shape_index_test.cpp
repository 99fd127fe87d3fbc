#include "core/loop/shape_index.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;
using signals::Wave;

double index_of(Wave kind, double period) {
  Random random(1);
  return *measure_shape_index(signals::wave(random, 2000, kind, period), period);
}

TEST(ShapeIndex, SeparatesTheShapes) {
  for (const double period : {20.0, 61.0, 300.0}) {
    EXPECT_LT(index_of(Wave::sine, period), 0.1);
    EXPECT_GT(index_of(Wave::triangle, period), 0.85);
  }
}

TEST(ShapeIndex, SquareWaveScoresItsClosedForm) {
  // Least squares of a half cycle of ones: the sine leaves 1 - 8 / pi^2 = 0.189, the triangle
  // 1 - 3 / 4 = 0.25; 0.189 / 0.439 = 0.43. The slope of the crossing adds to it at short periods.
  EXPECT_NEAR(index_of(Wave::square, 300.0), 0.43, 0.02);
  EXPECT_NEAR(index_of(Wave::square, 61.0), 0.43, 0.03);
}

TEST(ShapeIndex, PeaksMayLeanToOneSide) {
  Series triangle(2000);
  for (std::size_t k = 0; k < triangle.size(); ++k) {
    const double phase = static_cast<double>(k % 100) / 100.0;  // rises for 30 %, falls for 70 %
    triangle[k] = phase < 0.3 ? -1.0 + phase / 0.15 : 1.0 - (phase - 0.3) / 0.35;
  }
  EXPECT_GT(*measure_shape_index(triangle, 100.0), 0.85);
}

TEST(ShapeIndex, HalfCyclesAtAGapAreLeftOut) {
  Random random(2);
  Series sine = signals::wave(random, 2000, Wave::sine, 50.0);
  for (std::size_t k = 500; k < 900; ++k) sine[k] = std::nan("");
  EXPECT_LT(*measure_shape_index(sine, 50.0), 0.1);
}

TEST(ShapeIndex, NeedsHalfCyclesOfTheRightLength) {
  Random random(3);
  const Series sine = signals::wave(random, 2000, Wave::sine, 50.0);
  EXPECT_FALSE(measure_shape_index(sine, 500.0));
  EXPECT_FALSE(measure_shape_index(sine, 8.0));
  EXPECT_FALSE(measure_shape_index(Series(100, 0.0), 50.0));
  EXPECT_FALSE(measure_shape_index(Series{}, 50.0));
}

}  // namespace
}  // namespace loopscope::core::loop
