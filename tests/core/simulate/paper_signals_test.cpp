#include "core/simulate/paper_signals.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/support/numbers.hpp"

namespace loopscope::core::simulate {
namespace {

using loopscope::tests::kWindow;

double power_at(const std::vector<double>& signal, double frequency) {
  std::complex<double> sum;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    sum +=
        signal[k] * std::polar(1.0, -2.0 * std::numbers::pi * frequency * static_cast<double>(k));
  }
  return std::norm(sum) / static_cast<double>(signal.size());
}

double band_power(const std::vector<double>& signal, double low, double high) {
  double power = 0.0;
  for (double frequency = low; frequency < high; frequency += 1.0 / kWindow) {
    power += 2.0 * power_at(signal, frequency) / kWindow;
  }
  return power;
}

double variance(const std::vector<double>& signal) {
  double mean = 0.0;
  double square = 0.0;
  for (const double value : signal) {
    mean += value / static_cast<double>(signal.size());
    square += value * value / static_cast<double>(signal.size());
  }
  return square - mean * mean;
}

TEST(PaperSignals, SameSeedSameRecord) {
  for (const auto make :
       {narrow_band_linear, narrow_band_squared, two_sinusoids_linear, two_sinusoids_squared}) {
    EXPECT_EQ(make(kWindow, 3), make(kWindow, 3));
    EXPECT_NE(make(kWindow, 3), make(kWindow, 4));
    EXPECT_EQ(make(kWindow, 3).size(), kWindow);
  }
}

TEST(PaperSignals, NarrowBandLivesBetweenItsEdges) {
  // A Butterworth filter has its half power points at the edges: four fifths of what it passes
  // lie between them, and nearly all within twice the width.
  const std::vector<double> signal = narrow_band_linear(kWindow, 1);
  const double all = variance(signal);
  EXPECT_GT(band_power(signal, 0.095, 0.105), 0.75 * all);
  EXPECT_GT(band_power(signal, 0.085, 0.115), 0.95 * all);
}

TEST(PaperSignals, SquarePutsPowerAtTwiceTheBand) {
  const double linear = band_power(narrow_band_linear(kWindow, 1), 0.19, 0.21);
  const double squared = band_power(narrow_band_squared(kWindow, 1), 0.19, 0.21);
  EXPECT_GT(squared, 5.0 * linear);
}

TEST(PaperSignals, NoiseIsSharedByTheLinearAndTheSquaredSignal) {
  const std::vector<double> linear = two_sinusoids_linear(kWindow, 9);
  const std::vector<double> squared = two_sinusoids_squared(kWindow, 9);
  for (std::size_t k = 0; k < kWindow; ++k) {
    const double difference = squared[k] - linear[k];
    ASSERT_GE(difference, -1e-12);  // 0.05 x'^2
    ASSERT_LE(difference, 0.2 + 1e-12);
  }
}

TEST(PaperSignals, NoiseOfTwoSinusoidsHasVariance004) {
  // Two sinusoids of amplitude 1 carry a variance of 1; the noise's has a relative standard error
  // of sqrt(2 / 4096) = 2.2 %, five of which are allowed.
  EXPECT_NEAR(variance(two_sinusoids_linear(kWindow, 2)) - 1.0, 0.04, 0.02);
}

}  // namespace
}  // namespace loopscope::core::simulate
