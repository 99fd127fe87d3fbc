#include "core/loop/pv_plateaus.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::loop {
namespace {

constexpr double kCycle = 120.0;

template <typename Wave>
std::vector<double> repeated(Wave wave, std::size_t samples = 1200) {
  std::vector<double> signal(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double cycles = static_cast<double>(k) / kCycle;
    signal[k] = wave(cycles - std::floor(cycles));
  }
  return signal;
}
double sine_at(double x) {
  return std::sin(2.0 * std::numbers::pi * x);
}
double triangle_at(double x) {
  return 1.0 - 4.0 * std::abs(x - 0.5);
}
double plateaus_at(double x) {
  return x < 0.5 ? 1.0 : -1.0;
}

TEST(PvPlateaus, ASineHardlyRests) {
  const auto rests = measure_pv_plateaus(repeated(sine_at), repeated(sine_at), kCycle, false);
  ASSERT_TRUE(rests);
  EXPECT_NEAR(rests->move_kurtosis, 1.5, 0.05);
  EXPECT_NEAR(rests->time_share, 2.0 / std::numbers::pi * std::asin(0.25 / std::sqrt(2.0)), 0.02);
  EXPECT_NEAR(rests->cycles, 10.0, 1e-12);
}

TEST(PvPlateaus, OpTravelsWhilePvStandsOnItsPlateaus) {
  const auto rests =
      measure_pv_plateaus(repeated(plateaus_at), repeated(triangle_at), kCycle, false);
  ASSERT_TRUE(rests);
  EXPECT_GT(rests->move_kurtosis, 3.0);
  EXPECT_GT(rests->time_share, 0.6);
  EXPECT_GT(rests->op_travel_share, 0.6);
}

TEST(PvPlateaus, OfAVesselTheSlopeRests) {
  const auto rests =
      measure_pv_plateaus(repeated(triangle_at), repeated(triangle_at), kCycle, true);
  ASSERT_TRUE(rests);
  EXPECT_GT(rests->time_share, 0.6);
  EXPECT_LT(
      measure_pv_plateaus(repeated(triangle_at), repeated(triangle_at), kCycle, false)->time_share,
      0.2);
}

TEST(PvPlateaus, ThreeCyclesAreEnoughAndFewerAreNot) {
  EXPECT_TRUE(
      measure_pv_plateaus(repeated(plateaus_at, 370), repeated(triangle_at, 370), kCycle, false));
  EXPECT_FALSE(
      measure_pv_plateaus(repeated(plateaus_at, 350), repeated(triangle_at, 350), kCycle, false));
}

TEST(PvPlateaus, WhatCannotBeMeasuredIsNone) {
  const std::vector<double> still(1200, 3.0);
  EXPECT_FALSE(measure_pv_plateaus(still, repeated(sine_at), kCycle, false));
  EXPECT_FALSE(measure_pv_plateaus(repeated(sine_at), still, kCycle, false));
  EXPECT_FALSE(measure_pv_plateaus(repeated(sine_at), {}, kCycle, false));
  EXPECT_FALSE(measure_pv_plateaus(repeated(sine_at), repeated(sine_at), 4.0, false));
  EXPECT_FALSE(measure_pv_plateaus(repeated(sine_at), repeated(sine_at), std::nan(""), false));
}

TEST(PvPlateaus, MissingSamplesAreLeftOut) {
  std::vector<double> pv = repeated(plateaus_at);
  for (std::size_t k = 300; k < 360; ++k) pv[k] = signal::kMissing;
  const auto rests = measure_pv_plateaus(pv, repeated(triangle_at), kCycle, false);
  ASSERT_TRUE(rests);
  EXPECT_NEAR(
      rests->time_share,
      measure_pv_plateaus(repeated(plateaus_at), repeated(triangle_at), kCycle, false)->time_share,
      0.05);
}

}  // namespace
}  // namespace loopscope::core::loop
