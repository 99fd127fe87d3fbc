#include "core/hos/surrogates/locked_harmonics.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

/// Amplitude at a frequency, cycles per sample.
double amplitude(const std::vector<double>& signal, double frequency) {
  double re = 0.0;
  double im = 0.0;
  double count = 0.0;
  for (std::size_t t = 0; t < signal.size(); ++t) {
    if (!std::isfinite(signal[t])) continue;
    const double angle = 2.0 * std::numbers::pi * frequency * static_cast<double>(t);
    re += signal[t] * std::cos(angle);
    im += signal[t] * std::sin(angle);
    count += 1.0;
  }
  return 2.0 * std::hypot(re, im) / count;
}

std::vector<double> strict_square(double period, std::uint64_t seed) {
  auto wave = tests::affine(tests::white_noise(seed), 0.3, 5.0);
  for (std::size_t t = 0; t < wave.size(); ++t) {
    wave[t] += std::fmod(static_cast<double>(t), period) < period / 2.0 ? 1.0 : -1.0;
  }
  return wave;
}

TEST(HosLockedHarmonics, AreTakenOffAndTheFundamentalStays) {
  const auto wave = strict_square(32.0, 1);
  const auto left = without_locked_harmonics(wave, 32.0);
  EXPECT_GT(amplitude(wave, 3.0 / 32.0), 0.4);
  EXPECT_LT(amplitude(left, 3.0 / 32.0), 0.06);
  EXPECT_NEAR(amplitude(left, 1.0 / 32.0), amplitude(wave, 1.0 / 32.0), 0.02);
}

TEST(HosLockedHarmonics, OfALinearLoopNothingIsTaken) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto record = tests::resonance(seed);
    const auto left = without_locked_harmonics(record, 20.0);
    double before = 0.0;
    double taken = 0.0;
    for (std::size_t t = 0; t < record.size(); ++t) {
      before += record[t] * record[t];
      taken += (record[t] - left[t]) * (record[t] - left[t]);
    }
    EXPECT_LT(taken / before, 0.005);
  }
}

TEST(HosLockedHarmonics, WhatIsMissingStaysMissing) {
  auto wave = strict_square(32.0, 2);
  for (std::size_t t = 500; t < 900; ++t) wave[t] = std::nan("");
  const auto left = without_locked_harmonics(wave, 32.0);
  for (std::size_t t = 0; t < wave.size(); ++t) {
    ASSERT_EQ(std::isfinite(left[t]), std::isfinite(wave[t]));
  }
  EXPECT_LT(amplitude(left, 3.0 / 32.0), 0.08);
}

TEST(HosLockedHarmonics, AConstantHasNone) {
  for (const double value : without_locked_harmonics(std::vector<double>(1000, 3.0), 20.0)) {
    EXPECT_NEAR(value, 3.0, 1e-12);
  }
}

}  // namespace
}  // namespace loopscope::core::hos
