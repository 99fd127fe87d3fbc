#include "core/loop/horch.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/loop/oscillation.hpp"
#include "core/loop/shape.hpp"
#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

constexpr double kPeriod = 100.0;

/// cos(2 pi (lag - shift) / period): what two sinusoids of one period give.
Correlation cosine(double shift) {
  Correlation result{{}, static_cast<std::size_t>(kPeriod)};
  for (double lag = -kPeriod; lag <= kPeriod; lag += 1.0) {
    result.values.push_back(std::cos(2.0 * std::numbers::pi * (lag - shift) / kPeriod));
  }
  return result;
}

TEST(Horch, EvenCorrelationIsZero) {
  for (const double shift : {0.0, kPeriod / 2.0}) {
    const auto figures = measure_horch(cosine(shift), kPeriod);
    ASSERT_TRUE(figures);
    EXPECT_NEAR(figures->dtau, 0.0, 1e-9);
    EXPECT_NEAR(figures->drho, 0.0, 1e-9);
  }
}

TEST(Horch, OddCorrelationIsOne) {
  const auto figures = measure_horch(cosine(kPeriod / 4.0), kPeriod);
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->dtau, 1.0, 1e-6);
  EXPECT_NEAR(figures->drho, 1.0, 1e-6);
}

TEST(Horch, FollowsThePhaseInBetween) {
  // Shifted by a tenth of a period: tl = 15, tr = 35 samples; r0 = cos 36 degrees.
  const auto figures = measure_horch(cosine(kPeriod / 10.0), kPeriod);
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->dtau, 20.0 / 50.0, 1e-3);
  const double r0 = std::cos(0.2 * std::numbers::pi);
  EXPECT_NEAR(figures->drho, (1.0 - r0) / (1.0 + r0), 1e-3);
}

TEST(Horch, WithoutCrossingsThereIsNothingToSay) {
  EXPECT_FALSE(measure_horch(Correlation{}, kPeriod));
  EXPECT_FALSE(measure_horch(Correlation{std::vector<double>(201, 0.5), 100}, kPeriod));
}

/// The loop of section 5.3: Horch's rule (odd = stiction) is wrong about it, as the paper says.
TEST(Horch, OutsideSinusoidIsTakenForStiction) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    signals::Random random(seed);
    const auto loop =
        signals::simulate(random, 4096, {.sinusoid_amplitude = 2.0, .walk_std = 0.224});
    const Oscillation oscillation = find_oscillation(loop.pv, 1.0);
    ASSERT_TRUE(oscillation.present);
    const Shape shape = measure_shape({{}, loop.pv, loop.op, {}, oscillation.period_s, false});
    EXPECT_GT(*shape.horch_dtau, 2.0 / 3.0);
    EXPECT_GT(*shape.horch_drho, 1.0 / 3.0);
  }
}

TEST(Horch, SimulatedStictionIsOddToo) {
  signals::Random random(1);
  const auto loop = signals::simulate(
      random, 4096, {.stickband = 3.0, .slip_jump = 1.0, .walk_std = 0.05, .setpoint_step = 10.0});
  const Oscillation oscillation = find_oscillation(loop.pv, 1.0);
  ASSERT_TRUE(oscillation.present);
  const Shape shape = measure_shape({{}, loop.pv, loop.op, {}, oscillation.period_s, false});
  EXPECT_GT(*shape.horch_dtau, 2.0 / 3.0);
  EXPECT_GT(*shape.horch_drho, 1.0 / 3.0);
}

}  // namespace
}  // namespace loopscope::core::loop
