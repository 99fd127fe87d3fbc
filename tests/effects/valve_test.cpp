#include "tests/effects/valve.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/effects/load_model.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr Actuator kFast{.lag = 0.05, .start = 50.0};
constexpr double kRamp = 0.0005;  ///< % a substep: slow against actuator and stem

double settled(Valve& valve, double op) {
  double stem = 0.0;
  for (int i = 0; i < 50 * kSubsteps; ++i) stem = valve.step(op);
  return stem;
}

/// How far op has to go back from `op`, slowly, until a resting stem follows.
double band_at(Valve& valve, double op) {
  const double rest = settled(valve, op);
  double back = op;
  while (valve.step(back) > rest - 0.01 && back > op - 20.0) back -= kRamp;
  return op - back;
}

constexpr Friction kFriction{.static_friction = 2.5, .kinetic_friction = 1.0};  // S 3.5, J 1.5

/// Just below the static friction nothing moves, just above it the stem slips by J; S brings it
/// back.
void expect_stiction(Valve& valve) {
  EXPECT_NEAR(settled(valve, 52.49), 50.0, 1e-9);
  EXPECT_NEAR(settled(valve, 52.51), 51.51, 0.01);
  EXPECT_NEAR(band_at(valve, 52.51), 3.5, 0.05);
}

TEST(Valve, HeSlipsByJAndReversesAfterS) {
  expect_stiction(*make_he_valve(kFriction, kFast));
}

TEST(Valve, KarnoppSlipsByJAndReversesAfterS) {
  expect_stiction(*make_karnopp_valve(kFriction, kFast, 0.05));
  expect_stiction(*make_karnopp_valve(kFriction, kFast, 0.8));
}

TEST(Valve, BacklashLosesItsWidthAtAReversal) {
  const auto valve = make_backlash_valve(3.0, kFast, 0.05);
  double op = 50.0;
  double stem = 50.0;
  while (op < 60.0) stem = valve->step(op += kRamp);
  EXPECT_NEAR(op - stem, 1.5, 0.01);
  while (op > 50.0) stem = valve->step(op -= kRamp);
  EXPECT_NEAR(stem - op, 1.5, 0.01);
}

TEST(Valve, StopsBendWithinOnePercentAndAreStraightBetween) {
  const auto valve = make_stop_valve(20.0, 70.0, kFast);
  EXPECT_NEAR(settled(*valve, 45.0), 45.0, 1e-6);
  EXPECT_NEAR(settled(*valve, 69.0), 69.0, 0.01);
  EXPECT_NEAR(settled(*valve, 90.0), 70.0, 1e-6);
  EXPECT_NEAR(settled(*valve, 5.0), 20.0, 1e-6);
}

TEST(Valve, IntermittentStictionFollowsOutsideItsStretches) {
  const auto valve = make_intermittent_valve({2.0, 1.0}, kFast, {10.0, 60.0});
  for (int i = 0; i < 12 * kSubsteps; ++i) (void)valve->step(51.0);
  EXPECT_NEAR(valve->step(51.0), 51.0, 1e-6);
  for (int i = 0; i < 20 * kSubsteps; ++i) (void)valve->step(52.0);
  EXPECT_NEAR(valve->step(52.0), 51.0, 1e-6);
  EXPECT_NEAR(settled(*valve, 52.0), 52.0, 1e-6);
}

TEST(Valve, HuntingKeepsItsAmplitudeAndPeriod) {
  const auto valve = make_hunting_valve(2.0, 10.0, kFast);
  double least = 100.0;
  double most = 0.0;
  int crossings = 0;
  double last = 50.0;
  for (int i = 0; i < 1000 * kSubsteps; ++i) {
    const double stem = valve->step(50.0);
    least = std::min(least, stem);
    most = std::max(most, stem);
    crossings += last < 50.0 && stem >= 50.0 ? 1 : 0;
    last = stem;
  }
  EXPECT_NEAR(most - least, 4.0, 0.15);
  EXPECT_NEAR(crossings, 100, 5);
}

}  // namespace
}  // namespace loopscope::tests::effects
