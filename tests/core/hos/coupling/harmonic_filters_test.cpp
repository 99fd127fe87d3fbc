#include "core/hos/coupling/harmonic_filters.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/core/hos/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

using loopscope::tests::kTurn;

/// Three harmonics of amplitude 2, 0.7 and 0.3 and a parabola.
std::vector<double> harmonics_and_parabola(double period, std::size_t samples) {
  std::vector<double> signal(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const auto t = static_cast<double>(n);
    const double angle = kTurn * t / period;
    signal[n] = 2.0 * std::cos(angle + 0.4) + 0.7 * std::cos(2.0 * angle + 1.0) +
                0.3 * std::cos(3.0 * angle - 2.0) + 5.0 + 0.1 * t - 2e-4 * t * t;
  }
  return signal;
}

/// Samples of a segment, as the header says: 1.75 periods, 24 at least; the hop is a quarter of it.
std::size_t segment_of(double period) {
  return std::max<std::size_t>(24, static_cast<std::size_t>(std::lround(1.75 * period)));
}

TEST(HosHarmonicFilters, ReadAmplitudesAndPhasesExactly) {
  for (const double period : {8.0, 13.3, 50.0, 400.0}) {
    const auto found = HarmonicFilters(period).apply(harmonics_and_parabola(period, 4096));
    const std::size_t length = segment_of(period);
    ASSERT_EQ(found.positions.size(), (4096 - length) / (length / 4) + 1);
    for (std::size_t s = 0; s < found.positions.size(); ++s) {
      const double centre = static_cast<double>(found.positions[s] * (length / 4)) +
                            static_cast<double>(length - 1) / 2.0;
      const double angle = kTurn * centre / period;
      const auto& [first, second, third] = found.harmonics;
      EXPECT_LT(std::abs(first[s] - std::polar(2.0, angle + 0.4)), 1e-7) << period;
      EXPECT_LT(std::abs(second[s] - std::polar(0.7, 2.0 * angle + 1.0)), 1e-7) << period;
      EXPECT_LT(std::abs(third[s] - std::polar(0.3, 3.0 * angle - 2.0)), 1e-7) << period;
    }
  }
}

TEST(HosHarmonicFilters, AParabolaHasNoHarmonics) {
  std::vector<double> parabola(1000);
  for (std::size_t n = 0; n < parabola.size(); ++n) {
    const double t = static_cast<double>(n) / 500.0 - 1.0;
    parabola[n] = 3.0 - 2.0 * t + 7.0 * t * t;
  }
  const auto found = HarmonicFilters(60.0).apply(parabola);
  ASSERT_FALSE(found.positions.empty());
  for (std::size_t s = 0; s < found.positions.size(); ++s) {
    for (const auto& harmonic : found.harmonics) EXPECT_LT(std::abs(harmonic[s]), 1e-12);
  }
}

TEST(HosHarmonicFilters, DropTheSegmentsThatTouchAGap) {
  for (const double missing : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto signal = harmonics_and_parabola(20.0, 400);
    const auto whole = HarmonicFilters(20.0).apply(signal);
    signal[200] = missing;
    const auto gapped = HarmonicFilters(20.0).apply(signal);
    // Segments of 35 samples every 8: those that start at 168, 176, 184, 192 and 200 hold sample
    // 200.
    ASSERT_EQ(gapped.positions.size() + 5, whole.positions.size());
    EXPECT_EQ(gapped.positions[20], 20U);
    EXPECT_EQ(gapped.positions[21], 26U);
    for (std::size_t h = 0; h < 3; ++h) {
      EXPECT_EQ(gapped.harmonics[h][21], whole.harmonics[h][26]);
    }
  }
}

TEST(HosHarmonicFilters, NothingFitsIntoAShortRecord) {
  EXPECT_TRUE(HarmonicFilters(20.0).apply(tests::white_noise(1, 34)).positions.empty());
  EXPECT_EQ(HarmonicFilters(20.0).apply(tests::white_noise(1, 35)).positions.size(), 1U);
  EXPECT_TRUE(HarmonicFilters(20.0).apply({}).positions.empty());
}

TEST(HosHarmonicFilters, CentresAreThoseOfTheSegments) {
  // Segments of 70 samples every 17.
  const HarmonicFilters filters(40.0);
  EXPECT_EQ(filters.centre(0), 35U);
  EXPECT_EQ(filters.centre(3), 86U);
}

TEST(HosHarmonicFilters, NoiseCorrelationIsThatOfWhiteNoise) {
  const HarmonicFilters filters(20.0);
  const auto found = filters.apply(tests::white_noise(9, 1U << 19U));
  for (std::size_t harmonic = 1; harmonic <= 3; ++harmonic) {
    const auto expected = filters.noise_correlation(harmonic);
    ASSERT_EQ(expected.size(), 5U);
    EXPECT_NEAR(std::abs(expected[0] - 1.0), 0.0, 1e-14);
    const auto& amplitudes = found.harmonics[harmonic - 1];
    double power = 0.0;
    for (const Complex& a : amplitudes) power += std::norm(a);
    for (std::size_t lag = 1; lag < expected.size(); ++lag) {
      Complex sum;
      for (std::size_t s = 0; s + lag < amplitudes.size(); ++s) {
        sum += amplitudes[s] * std::conj(amplitudes[s + lag]);
      }
      // 65 000 segments, of which about 20 000 are independent: a standard error of 0.007.
      EXPECT_LT(std::abs(sum / power - expected[lag]), 0.03) << harmonic << ' ' << lag;
    }
  }
}

}  // namespace
}  // namespace loopscope::core::hos
