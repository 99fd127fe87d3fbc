#include "core/loop/shape.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;
using signals::Wave;

double index_at(Wave kind, double snr_db) {
  Random random(1);
  const Series op = signals::at_snr(signals::wave(random, 4096, kind, 100.0),
                                    signals::white(random, 4096), snr_db);
  return *measure_shape({{}, op, op, {}, 100.0, false}).shape_index;
}

TEST(Shape, IndexSeparatesNoisyWaves) {
  EXPECT_LT(index_at(Wave::sine, 10.0), 0.4);
  EXPECT_GT(index_at(Wave::triangle, 10.0), 0.6);
  EXPECT_NEAR(index_at(Wave::square, 10.0), 0.44, 0.04);
}

TEST(Shape, IntegratingLoopIsReadFromPv) {
  Random random(2);
  const Series op = signals::wave(random, 2000, Wave::sine, 100.0);
  const Series pv = signals::wave(random, 2000, Wave::triangle, 100.0);
  EXPECT_LT(*measure_shape({{}, pv, op, {}, 100.0, false}).shape_index, 0.4);
  EXPECT_GT(*measure_shape({{}, pv, op, {}, 100.0, true}).shape_index, 0.6);
}

TEST(Shape, StictionIsToldFromAnOutsideSinusoidByShape) {
  Random random(3);
  const auto sticking = signals::simulate(
      random, 4096, {.stickband = 3.0, .slip_jump = 1.0, .walk_std = 0.05, .setpoint_step = 10.0});
  const auto disturbed =
      signals::simulate(random, 4096, {.sinusoid_amplitude = 2.0, .walk_std = 0.05});
  const auto period = find_oscillation(sticking.pv, 1.0).period_s;
  EXPECT_GT(*measure_shape({{}, sticking.pv, sticking.op, {}, period, false}).shape_index, 0.6);
  EXPECT_LT(*measure_shape({{}, disturbed.pv, disturbed.op, {}, 100.0, false}).shape_index, 0.4);
}

TEST(Shape, WithoutOscillationOnlyTheValveIsMeasured) {
  Random random(4);
  Series op = signals::wave(random, 2000, Wave::sine, 100.0);
  for (double& v : op) v *= 5.0;
  const Series mv = signals::through_valve(op, 2.0, 0.0);
  const Shape shape = measure_shape({{}, mv, op, mv, std::nullopt, false});
  EXPECT_FALSE(shape.horch_dtau || shape.horch_drho || shape.shape_index ||
               shape.ellipse_stiction || shape.ellipse_r2);
  EXPECT_TRUE(shape.mv_op_width && shape.mv_stuck_fraction);
}

void expect_nothing(const ShapeInput& input) {
  const Shape shape = measure_shape(input);
  EXPECT_FALSE(shape.horch_dtau || shape.horch_drho || shape.shape_index ||
               shape.ellipse_stiction || shape.ellipse_r2 || shape.mv_op_width ||
               shape.mv_stuck_fraction);
}

TEST(Shape, MissingOrConstantOpGivesNothing) {
  Random random(5);
  const Series pv = signals::wave(random, 1000, Wave::sine, 50.0);
  const Series constant(1000, 40.0), missing(1000, std::nan(""));
  expect_nothing({pv, pv, {}, {}, 50.0, false});
  expect_nothing({pv, pv, constant, {}, 50.0, false});
  expect_nothing({pv, pv, missing, {}, 50.0, false});
  expect_nothing({pv, constant, pv, {}, 50.0, false});
  expect_nothing({{}, {}, {}, {}, 50.0, false});
  for (const double period : {0.0, -3.0, 1e9, std::nan("")}) {
    expect_nothing({pv, pv, pv, {}, period, false});
  }
}

void expect_finite(std::initializer_list<std::optional<double>> figures) {
  for (const auto& figure : figures) EXPECT_TRUE(!figure || std::isfinite(*figure));
}

/// Whatever is recorded, no figure of the room is NaN or infinite, and shares stay within 0 to 1.
void expect_sane(const Series& series, const Series& other, double period) {
  const Oscillation o = find_oscillation(series, 1.0);
  expect_finite({o.period_s, o.regularity, o.amplitude, o.persistence});
  const Performance p = measure_performance(series, other, {}, 1.0);
  expect_finite({p.harris_low, p.harris_high, p.error_std, p.valve_travel_per_h, p.reversals_per_h,
                 p.at_limit_fraction});
  const Shape s = measure_shape({series, series, other, series, period, false});
  expect_finite({s.horch_dtau, s.horch_drho, s.shape_index, s.ellipse_stiction, s.ellipse_r2,
                 s.mv_op_width, s.mv_stuck_fraction});
  for (const auto& share : {p.harris_low, p.harris_high, o.persistence, s.horch_dtau, s.horch_drho,
                            s.shape_index, s.ellipse_r2, s.mv_stuck_fraction}) {
    EXPECT_TRUE(!share || (*share >= 0.0 && *share <= 1.0));
  }
}

TEST(LoopFigures, AreFiniteForEveryPatternOfMissingSamples) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const std::size_t count = std::uniform_int_distribution<std::size_t>(1, 400)(random);
    const double missing = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    Series series = signals::with_missing(random, signals::ar1(random, count, 1.0), missing);
    const Series other =
        signals::with_missing(random, signals::resonance(random, count, 15.0, 0.99), missing);
    // A block is missing as well.
    const std::size_t from = count / 3;
    for (std::size_t k = from; k < from + count / 4; ++k) series[k] = std::nan("");
    expect_sane(series, other, 15.0);
  }
}

TEST(LoopFigures, AreFiniteForEveryMagnitude) {
  Random random(1);
  const Series base = signals::wave(random, 600, Wave::square, 30.0);
  for (const double scale : {0.0, 1e-300, 1e-150, 1e-12, 1e12, 1e150, 1e300}) {
    Series scaled = base;
    for (double& v : scaled) v *= scale;
    expect_sane(scaled, base, 30.0);
    expect_sane(base, scaled, 30.0);
    expect_sane(scaled, scaled, 30.0);
  }
}

TEST(LoopFigures, AreFiniteForOddSeries) {
  const double infinity = std::numeric_limits<double>::infinity();
  Series spike(300, 1.0), step(300, 0.0), infinite(300, 2.0), alternating(300);
  spike[150] = 1e9;
  std::fill(step.begin() + 100, step.end(), 1.0);
  infinite[10] = infinity;
  infinite[20] = -infinity;
  infinite[30] = 3.0;
  for (std::size_t k = 0; k < alternating.size(); ++k) alternating[k] = k % 2 == 0 ? 1.0 : -1.0;
  for (const Series& series : {Series{}, Series{1.0}, Series{1.0, 2.0}, Series(300, 7.0), spike,
                               step, infinite, alternating}) {
    for (const double period : {2.0, 10.0, 100.0}) expect_sane(series, series, period);
  }
}

}  // namespace
}  // namespace loopscope::core::loop
