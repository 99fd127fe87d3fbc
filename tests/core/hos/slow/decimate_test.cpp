#include "core/hos/slow/decimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/core/hos/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kNaN;
using loopscope::tests::kTurn;

std::vector<double> cosine(double frequency, double phase, std::size_t length) {
  std::vector<double> x(length);
  for (std::size_t k = 0; k < length; ++k) {
    x[k] = std::cos(kTurn * frequency * static_cast<double>(k) + phase);
  }
  return x;
}

/// Gain at `frequency` cycles per raw sample, from one kept sample of two quadratures.
double gain(double frequency, std::size_t factor) {
  const std::size_t length = 2 * kDecimationHalfSupport * factor + 1;
  return std::hypot(decimate(cosine(frequency, 0.0, length), factor).at(0),
                    decimate(cosine(frequency, kTurn / 4.0, length), factor).at(0));
}

/// Largest of `measure(gain)` over `from` to `to` cycles per kept sample.
template <typename Measure>
double worst(double from, double to, std::size_t factor, Measure measure) {
  double largest = 0.0;
  for (double kept = from; kept <= to; kept += 0.01) {
    largest = std::max(largest, measure(gain(kept / static_cast<double>(factor), factor)));
  }
  return largest;
}

class Decimate : public testing::TestWithParam<std::size_t> {};

TEST_P(Decimate, NothingFoldsOverAndThePassbandIsFlat) {
  const std::size_t factor = GetParam();
  const double nyquist = 0.5 * static_cast<double>(factor);
  const double aliased = worst(0.5, nyquist, factor, [](double g) { return g; });
  const double ripple =
      worst(0.0, kDecimationPassband, factor, [](double g) { return std::abs(g - 1.0); });
  std::printf("factor %2zu: aliases at %.1f dB or less, passband within %.5f\n", factor,
              20.0 * std::log10(aliased), ripple);
  EXPECT_LE(aliased, 1e-3);  // 60 dB
  EXPECT_LE(ripple, 1e-3);
}

TEST_P(Decimate, NoPhaseIsShifted) {
  const std::size_t factor = GetParam();
  const double frequency = 0.25 / static_cast<double>(factor);
  const std::vector<double> x = cosine(frequency, 0.7, 100 * factor);
  const std::vector<double> kept = decimate(x, factor);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    EXPECT_NEAR(kept[k], x[(kDecimationHalfSupport + k) * factor], 1e-3);
  }
}

TEST_P(Decimate, KeepsSoManySamples) {
  const std::size_t factor = GetParam();
  for (const std::size_t size :
       {24 * factor, 24 * factor + 1, 25 * factor, 25 * factor + 1, std::size_t{4096}}) {
    const std::size_t shifted = (size - 1) / factor;
    EXPECT_EQ(decimate(std::vector<double>(size), factor).size(), shifted < 24 ? 0 : shifted - 23);
  }
}

TEST_P(Decimate, AConstantStaysWhatItIsAroundGapsToo) {
  const std::size_t factor = GetParam();
  std::vector<double> x(60 * factor, 1e6);
  x[30 * factor + 1] = kNaN;
  for (std::size_t k = 45 * factor; k < 48 * factor; ++k) x[k] = kNaN;
  std::size_t missing = 0;
  for (const double value : decimate(x, factor)) {
    missing += std::isnan(value) ? 1U : 0U;
    EXPECT_TRUE(std::isnan(value) || std::abs(value - 1e6) < 1e-6) << value;
  }
  EXPECT_GE(missing, 3U);
}

/// 20 seeds of a wave of twelve kept samples a cycle with gaps of up to two cycles.
TEST_P(Decimate, WhatIsKeptBesideGapsIsNearlyWhatItWouldBe) {
  const std::size_t factor = GetParam();
  double largest = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<double> whole =
        cosine(1.0 / (12.0 * static_cast<double>(factor)), static_cast<double>(seed), 300 * factor);
    std::vector<double> gappy = whole;
    std::mt19937_64 random(seed);
    for (int gap = 0; gap < 5; ++gap) {
      const std::size_t start = random() % (270 * factor);
      const std::size_t length = 1 + random() % (24 * factor);
      std::fill_n(gappy.begin() + static_cast<std::ptrdiff_t>(start), length, kNaN);
    }
    const std::vector<double> expected = decimate(whole, factor);
    const std::vector<double> kept = decimate(gappy, factor);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (std::isfinite(kept[k])) largest = std::max(largest, std::abs(kept[k] - expected[k]));
    }
  }
  std::printf("factor %2zu: largest error beside a gap %.4f of the amplitude\n", factor, largest);
  EXPECT_LE(largest, 0.1);  // 5 % of the weights on a swing of 2
}

INSTANTIATE_TEST_SUITE_P(Factors, Decimate, testing::Values(2, 4, 17, 55));

TEST(DecimateGaps, TouchOnlyTheirNeighbourhood) {
  constexpr std::size_t kFactor = 5;
  const std::vector<double> whole = tests::white_noise(3, 400 * kFactor);
  std::vector<double> gappy = whole;
  std::fill_n(gappy.begin() + 1000, 10, std::numeric_limits<double>::infinity());
  const std::vector<double> expected = decimate(whole, kFactor);
  const std::vector<double> kept = decimate(gappy, kFactor);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::size_t centre = (kDecimationHalfSupport + k) * kFactor;
    if (centre >= 1000 && centre < 1010) {
      EXPECT_TRUE(std::isnan(kept[k])) << k;
    }
    const bool clear = centre + kDecimationHalfSupport * kFactor < 1000 ||
                       centre >= 1010 + kDecimationHalfSupport * kFactor;
    if (clear) {
      EXPECT_EQ(kept[k], expected[k]) << k;
    }
  }
}

TEST(DecimateFactor, OneKeepsTheSignalAndZeroIsRefused) {
  const std::vector<double> x = {1.0, 2.0, 3.0};
  EXPECT_EQ(decimate(x, 1), x);
  EXPECT_THROW((void)decimate(x, 0), std::invalid_argument);
  EXPECT_TRUE(decimate({}, 3).empty());
}

}  // namespace
}  // namespace loopscope::core::hos
