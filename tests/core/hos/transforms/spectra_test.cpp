#include "core/hos/transforms/spectra.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/hos/transforms/window.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

/// Spectrum of one segment by the definition: its mean removed, tapered, padded with zeros.
std::complex<double> naive(std::span<const double> segment, const Settings& settings,
                           std::size_t k) {
  const auto window = make_window(settings.window, segment.size());
  const double mean =
      std::accumulate(segment.begin(), segment.end(), 0.0) / static_cast<double>(segment.size());
  std::complex<double> sum;
  for (std::size_t n = 0; n < segment.size(); ++n) {
    const double turn = static_cast<double>(k * n) / static_cast<double>(settings.dft_length);
    sum += window[n] * (segment[n] - mean) * std::polar(1.0, -2.0 * std::numbers::pi * turn);
  }
  return sum;
}

TEST(HosSpectra, RowsHoldTheSegmentsByTheDefinition) {
  const Settings settings{.segment_length = 32, .overlap = 0.5, .dft_length = 40};
  const auto signal = tests::affine(tests::white_noise(3, 32 * 6), 5.0, 100.0);
  Spectra spectra(settings);
  spectra.compute(signal);
  ASSERT_EQ(spectra.segments(), 11U);
  ASSERT_EQ(spectra.frequencies(), 21U);
  for (std::size_t k = 0; k < spectra.frequencies(); ++k) {
    double power = 0.0;
    for (std::size_t s = 0; s < spectra.segments(); ++s) {
      const std::complex<double> found(spectra.real(k)[s], spectra.imaginary(k)[s]);
      const auto expected = naive(std::span(signal).subspan(16 * s, 32), settings, k);
      EXPECT_LT(std::abs(found * spectra.scale() - expected), 1e-10);
      EXPECT_DOUBLE_EQ(spectra.power(k)[s], std::norm(found));
      power += std::norm(found);
    }
    EXPECT_NEAR(spectra.total_power(k), power, 1e-12 * power);
  }
}

TEST(HosSpectra, PaddingIsZero) {
  Spectra spectra(Settings{});
  spectra.compute(tests::white_noise(4, 64 * 5));
  ASSERT_EQ(spectra.segments(), 9U);
  ASSERT_EQ(spectra.row_length(), 16U);
  for (std::size_t k = 0; k < spectra.frequencies() + Spectra::kZeroFrequencies; ++k) {
    const std::size_t first = k < spectra.frequencies() ? 9 : 0;
    for (std::size_t s = first; s < spectra.row_length(); ++s) {
      EXPECT_EQ(spectra.real(k)[s], 0.0);
      EXPECT_EQ(spectra.imaginary(k)[s], 0.0);
      EXPECT_EQ(spectra.power(k)[s], 0.0);
    }
  }
}

TEST(HosSpectra, ScaleIsAPowerOfTwoAndExact) {
  Spectra spectra(Settings{});
  const auto signal = tests::white_noise(5, 256);
  spectra.compute(signal);
  const double scale = spectra.scale();
  const double real = spectra.real(7)[2];
  for (const double gain : {0x1p-1060, 0x1p-30, 0x1p900}) {
    spectra.compute(tests::affine(signal, gain, 0.0));
    if (gain > 0x1p-1000) {  // below, samples are subnormal and have lost digits
      EXPECT_EQ(spectra.scale(), scale * gain);
      EXPECT_EQ(spectra.real(7)[2], real);
    }
    EXPECT_NEAR(spectra.real(7)[2] * spectra.scale() / gain, real * scale, 1e-3);
  }
}

TEST(HosSpectra, RoundingNoiseOfAConstantIsNoPower) {
  for (const std::size_t segment_length : {64U, 4096U}) {
    Spectra spectra({.segment_length = segment_length, .dft_length = 2 * segment_length});
    for (const double level : {0.1, 1.0 / 3.0, 1e300, 1e-300, -7.7e6}) {
      std::vector<double> signal(3 * segment_length, level);
      for (std::size_t k = 0; k < signal.size(); k += 3) {
        signal[k] = std::nextafter(level, 0.0);  // a computed constant: its last digit moves
      }
      spectra.compute(signal);
      for (std::size_t k = 0; k < spectra.frequencies(); ++k) {
        ASSERT_EQ(spectra.total_power(k), 0.0) << level;
      }
    }
  }
}

TEST(HosSpectra, AnObjectForgetsTheSignalBefore) {
  const auto record = tests::white_noise(6);
  Spectra used(Settings{});
  used.compute(tests::white_noise(7, 8192));
  used.compute(record);
  Spectra fresh(Settings{});
  fresh.compute(record);
  ASSERT_EQ(used.row_length(), fresh.row_length());
  for (std::size_t k = 0; k < fresh.frequencies(); ++k) {
    for (std::size_t s = 0; s < fresh.row_length(); ++s) {
      ASSERT_EQ(used.real(k)[s], fresh.real(k)[s]);
      ASSERT_EQ(used.imaginary(k)[s], fresh.imaginary(k)[s]);
    }
  }
}

TEST(HosSpectra, ScaledSegmentsAreThoseOfAScaledSignal) {
  const Settings settings{.overlap = 0.0};
  auto signal = tests::white_noise(8, 640);
  Spectra scaled(settings);
  scaled.compute(signal);
  const std::vector<double> factors = {1.0, 2.0, 0.5, 1.3, 0.7, 3.0, 1.0, 0.1, 1.1, 0.9};
  scaled.scale_segments(factors);
  for (std::size_t n = 0; n < signal.size(); ++n) signal[n] *= factors[n / 64];
  Spectra expected(settings);
  expected.compute(signal);
  const double unit = expected.scale() / scaled.scale();
  for (std::size_t k = 0; k < expected.frequencies(); ++k) {
    EXPECT_NEAR(scaled.total_power(k), expected.total_power(k) * unit * unit, 1e-9);
    for (std::size_t s = 0; s < factors.size(); ++s) {
      ASSERT_NEAR(scaled.real(k)[s], expected.real(k)[s] * unit, 1e-12);
      ASSERT_NEAR(scaled.imaginary(k)[s], expected.imaginary(k)[s] * unit, 1e-12);
      ASSERT_NEAR(scaled.power(k)[s], expected.power(k)[s] * unit * unit, 1e-11);
    }
  }
}

TEST(HosSpectra, ScalingLeavesABinOfRoundingNoiseEmpty) {
  Spectra spectra(Settings{});
  spectra.compute(std::vector<double>(640, 0.1));
  spectra.scale_segments(std::vector<double>(spectra.segments(), 2.0));
  for (std::size_t k = 0; k < spectra.frequencies(); ++k) EXPECT_EQ(spectra.total_power(k), 0.0);
}

}  // namespace
}  // namespace loopscope::core::hos
