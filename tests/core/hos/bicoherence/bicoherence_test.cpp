#include "core/hos/bicoherence/bicoherence.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>

#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

std::vector<double> estimate(std::span<const double> signal, const Settings& settings = {}) {
  Bicoherence bicoherence(settings);
  const auto bic2 = bicoherence.estimate(signal);
  return {bic2.begin(), bic2.end()};
}

void expect_equal(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i], b[i], tolerance) << i;
  }
}

TEST(HosBicoherence, LiesWithinZeroAndOne) {
  const WindowShape shapes[] = {WindowShape::hann, WindowShape::hann_periodic, WindowShape::hamming,
                                WindowShape::rectangular};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    // From two segments on, where values near 1 are the rule.
    const std::size_t length = 96 + 37 * seed;
    const Settings settings{.window = shapes[seed % 4]};
    for (const auto& signal :
         {tests::white_noise(seed, length), tests::exponential_noise(seed, length),
          tests::first_order_noise(seed, 1.0, length)}) {
      const auto bic2 = estimate(signal, settings);
      ASSERT_FALSE(bic2.empty());
      const auto [low, high] = std::minmax_element(bic2.begin(), bic2.end());
      EXPECT_GE(*low, 0.0);
      EXPECT_LE(*high, 1.0);
    }
  }
}

TEST(HosBicoherence, IsOneForARepeatedSegment) {
  // Segments that do not overlap and all hold the same samples: nothing varies, all is coupled.
  const auto segment = tests::white_noise(8, 64);
  std::vector<double> signal;
  for (int copy = 0; copy < 10; ++copy) {
    signal.insert(signal.end(), segment.begin(), segment.end());
  }
  for (const double value : estimate(signal, {.overlap = 0.0})) {
    EXPECT_NEAR(value, 1.0, 1e-12);
  }
}

TEST(HosBicoherence, ScaleAndOffsetChangeNothing) {
  const auto signal = tests::triple(9, 0.2, 0.11, true);
  const auto expected = estimate(signal);
  expect_equal(estimate(tests::affine(signal, -4.0, 0.0)), expected, 1e-14);
  expect_equal(estimate(tests::affine(signal, 3.7e-9, 0.0)), expected, 1e-12);
  // An offset of a thousand standard deviations costs three of the sixteen digits.
  expect_equal(estimate(tests::affine(signal, 1.0, 1000.0)), expected, 1e-10);
}

TEST(HosBicoherence, SurvivesTheWholeRangeOfDouble) {
  const auto signal = tests::white_noise(10);
  const auto expected = estimate(signal);
  for (const double gain : {0x1p1020, 0x1p-1000}) {
    expect_equal(estimate(tests::affine(signal, gain, 0.0)), expected, 0.0);
  }
}

TEST(HosBicoherence, TimeReversalChangesNothing) {
  // The grid of segments has to be the same from both ends: 4096 = 64 + 126 * 32.
  auto signal = tests::triple(11, 0.2, 0.11, true);
  const auto expected = estimate(signal);
  std::reverse(signal.begin(), signal.end());
  expect_equal(estimate(signal), expected, 1e-12);
}

/// Mean over bifrequencies of which none of the three frequencies lies within the main lobe of
/// another, of zero or of the Nyquist frequency: their spectra are independent on white noise.
double interior_mean(std::span<const double> bic2) {
  const PrincipalDomain domain(128);
  constexpr std::size_t kLobe = 4;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < bic2.size(); ++i) {
    const auto [k1, k2] = domain.at(i);
    if (k2 > kLobe && k1 > k2 + kLobe && k1 + k2 < 64 - kLobe) {
      sum += bic2[i];
      count += 1.0;
    }
  }
  return sum / count;
}

TEST(HosBicoherence, MeanOnWhiteNoiseIsOneOverK) {
  // Given X1 and X2 of independent segments, bic2 is the squared correlation with an independent
  // complex Gaussian, Beta(1, K - 1): its mean is 1 / K exactly. Half overlapping Hann segments
  // correlate by 1/6, their triple products by (1/6)^3 with each of two neighbours: 1 + 2/216.
  // The standard deviation of one record's interior mean is 0.00096 (20 000 records); four
  // standard errors over 500 records.
  double sum = 0.0;
  constexpr int kRecords = 500;
  Bicoherence bicoherence{Settings{}};
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    sum += interior_mean(bicoherence.estimate(tests::white_noise(seed)));
  }
  EXPECT_NEAR(sum / kRecords, (1.0 + 2.0 / 216.0) / 127.0, 4.0 * 0.00096 / std::sqrt(500.0));
}

TEST(HosBicoherence, LargestValueOfACoupledTripleIsAtItsFrequencies) {
  const PrincipalDomain domain(128);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto bic2 =
        estimate(tests::triple(seed, 26.0 / 128.0, 14.0 / 128.0, true), {.overlap = 0.0});
    const auto largest = std::max_element(bic2.begin(), bic2.end());
    const auto at = domain.at(static_cast<std::size_t>(largest - bic2.begin()));
    EXPECT_NEAR(static_cast<double>(at.k1), 26.0, 2.0) << seed;  // within the main lobe
    EXPECT_NEAR(static_cast<double>(at.k2), 14.0, 2.0) << seed;
    EXPECT_GT(*largest, 0.5) << seed;
  }
}

TEST(HosBicoherence, AnUncoupledTripleStaysInTheNoise) {
  // Phases that are drawn apart: K bic2 at the triple is exponential with mean 1. Over 50 records
  // the mean of K bic2 has a standard error of 0.14.
  const PrincipalDomain domain(128);
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto bic2 =
        estimate(tests::triple(seed, 26.0 / 128.0, 14.0 / 128.0, false), {.overlap = 0.0});
    sum += 64.0 * bic2[domain.index({26, 14})];
  }
  EXPECT_NEAR(sum / 50.0, 1.0, 4.0 * 0.14);
}

TEST(HosBicoherence, DroppedSegmentsLeaveTheOthers) {
  // Not overlapping, so that a record without the third and seventh segment can be written down.
  const auto signal = tests::triple(12, 0.2, 0.11, true);
  auto with_gaps = signal;
  with_gaps[2 * 64 + 5] = std::nan("");
  with_gaps[6 * 64] = std::nan("");
  auto without = signal;
  without.erase(without.begin() + 6 * 64, without.begin() + 7 * 64);
  without.erase(without.begin() + 2 * 64, without.begin() + 3 * 64);
  const Settings settings{.overlap = 0.0};
  Bicoherence bicoherence(settings);
  (void)bicoherence.estimate(with_gaps);
  EXPECT_EQ(bicoherence.segments(), 62U);
  expect_equal(estimate(with_gaps, settings), estimate(without, settings), 1e-14);
}

TEST(HosBicoherence, EmptyWithoutTwoSegmentsOrVariance) {
  EXPECT_TRUE(estimate({}).empty());
  EXPECT_TRUE(estimate(tests::white_noise(1, 95)).empty());
  EXPECT_FALSE(estimate(tests::white_noise(1, 96)).empty());
  EXPECT_TRUE(estimate(std::vector<double>(4096, std::nan(""))).empty());
  for (const double level : {0.0, 0.1, 1e300, -12345.678}) {
    EXPECT_TRUE(estimate(std::vector<double>(4096, level)).empty()) << level;
  }
}

TEST(HosBicoherence, BinsWithoutPowerHaveZero) {
  // Whole periods in a segment and no taper: all bins but those of the line hold rounding noise.
  std::vector<double> signal(4096);
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double turn = static_cast<double>(k % 8) / 8.0;
    signal[k] =
        std::cos(2.0 * std::numbers::pi * turn) + std::cos(2.0 * std::numbers::pi * 2.0 * turn);
  }
  const Settings settings{.window = WindowShape::rectangular, .dft_length = 64};
  const PrincipalDomain domain(64);
  const auto bic2 = estimate(signal, settings);
  ASSERT_FALSE(bic2.empty());
  for (std::size_t i = 0; i < bic2.size(); ++i) {
    const double expected = domain.at(i) == Bifrequency{8, 8} ? 1.0 : 0.0;
    EXPECT_NEAR(bic2[i], expected, 1e-12) << i;
  }
}

TEST(HosBicoherence, OneObjectServesManySignals) {
  Bicoherence bicoherence{Settings{}};
  (void)bicoherence.estimate(tests::white_noise(13, 8192));
  const auto again = bicoherence.estimate(tests::white_noise(14));
  expect_equal({again.begin(), again.end()}, estimate(tests::white_noise(14)), 0.0);
}

TEST(HosBicoherence, ScaledSegmentsAreThoseOfAScaledSignal) {
  const Settings settings{.overlap = 0.0};
  auto signal = tests::triple(15, 0.10, 0.16, true);
  std::vector<double> factors(64);
  for (std::size_t s = 0; s < factors.size(); ++s) {
    factors[s] = 1.0 + 0.5 * std::sin(static_cast<double>(s));
  }
  Bicoherence bicoherence(settings);
  const auto before = estimate(signal, settings);
  (void)bicoherence.estimate(signal);
  bicoherence.scale_segments(factors);
  const auto scaled = bicoherence.average();
  for (std::size_t n = 0; n < signal.size(); ++n) signal[n] *= factors[n / 64];
  expect_equal({scaled.begin(), scaled.end()}, estimate(signal, settings), 1e-12);
  EXPECT_GT(std::abs(scaled[100] - before[100]), 1e-6);
}

TEST(HosBicoherence, AFactorOfOneChangesNothing) {
  const auto signal = tests::triple(16, 0.10, 0.16, true);
  Bicoherence bicoherence{Settings{}};
  (void)bicoherence.estimate(signal);
  bicoherence.scale_segments(std::vector<double>(bicoherence.segments(), 1.0));
  const auto scaled = bicoherence.average();
  expect_equal({scaled.begin(), scaled.end()}, estimate(signal), 0.0);
}

TEST(HosBicoherence, SettingsOutOfRangeThrow) {
  EXPECT_THROW(Bicoherence({.segment_length = 15}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::hos
