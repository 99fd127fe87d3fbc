#include "core/model/limit_cycle/half_cycles.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "core/simulate/random.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kPeriod = 40.0;

template <typename Wave>
std::vector<double> repeat(Wave wave, double shift = 0.0) {
  std::vector<double> signal(1000);
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double cycles = (static_cast<double>(k) + shift) / kPeriod;
    signal[k] = wave(cycles - std::floor(cycles));
  }
  return signal;
}
double sine_wave(double x) {
  return std::sin(2.0 * std::numbers::pi * x);
}
double triangle_wave(double x) {
  return 1.0 - 4.0 * std::abs(x - 0.5);
}
double square_wave(double x) {
  return x < 0.5 ? 1.0 : -1.0;
}

TEST(HalfCycles, ThirdHarmonicNamesTheShapeWhateverItsShift) {
  const std::vector<OpTurn> turns = find_op_turns(repeat(triangle_wave), 0.6);
  for (const double shift : {0.0, 7.0, 15.0}) {
    const auto of = [&](const std::vector<double>& s) { return *mean_half_cycle(s, turns); };
    EXPECT_NEAR(of(repeat(sine_wave, shift)).third_harmonic, 0.0, 0.01);
    EXPECT_NEAR(of(repeat(triangle_wave, shift)).third_harmonic, -1.0 / 9.0, 0.02);
    EXPECT_NEAR(of(repeat(square_wave, shift)).third_harmonic, 1.0 / 3.0, 0.04);
    EXPECT_GT(of(repeat(square_wave, shift)).coherence, 0.98);
  }
}

TEST(HalfCycles, NoiseIsNotCoherent) {
  simulate::GaussianSource normal(3);
  std::vector<double> noise(2000);
  for (double& value : noise) value = normal.next();
  const std::vector<OpTurn> turns = find_op_turns(repeat(triangle_wave), 0.6);
  EXPECT_LT(mean_half_cycle(noise, turns)->coherence, 0.1);
}

TEST(HalfCycles, TriangleShareOfSineAndTriangle) {
  EXPECT_LT(*triangle_share(repeat(sine_wave), kPeriod), 0.1);
  EXPECT_GT(*triangle_share(repeat(triangle_wave), kPeriod), 0.9);
}

TEST(HalfCycles, TooFewAreNone) {
  const std::vector<double> wave = repeat(sine_wave);
  EXPECT_FALSE(mean_half_cycle(wave, {}).has_value());
  EXPECT_FALSE(triangle_share(std::vector{1.0, -1.0, 1.0}, kPeriod).has_value());
}

}  // namespace
}  // namespace loopscope::core::model
