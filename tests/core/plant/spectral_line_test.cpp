#include "core/plant/spectral_line.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "core/hos/numeric/normal_draw.hpp"
#include "core/plant/periodogram.hpp"
#include "tests/core/plant/oscillators.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::plant {
namespace {

using loopscope::tests::kWindow;

/// Noise behind two real poles, or a resonance of damping `zeta` at `period`.
std::vector<double> filtered(double first, double second, std::mt19937_64& random) {
  std::vector<double> x(kWindow + 500);
  for (std::size_t k = 2; k < x.size(); ++k)
    x[k] = first * x[k - 1] + second * x[k - 2] + hos::normal_draw(random);
  return {x.begin() + 500, x.end()};
}

std::vector<double> resonance(double zeta, double period, std::mt19937_64& random) {
  const double turn = 2.0 * std::numbers::pi / period;
  const double radius = std::exp(-zeta * turn);
  return filtered(2.0 * radius * std::cos(turn * std::sqrt(1.0 - zeta * zeta)), -radius * radius,
                  random);
}

double least_p(const std::vector<double>& error) {
  const LineSpectrum spectrum(error, 1.0);
  double p = 1.0;
  for (const SpectralLine& line : spectrum.lines(0.01)) p = std::min(p, line.p);
  return p;
}

TEST(SpectralLine, SmoothSpectraShowNone) {
  // White, slow, random walk, well damped resonances: the null allows a height of 2.5, so that far
  // fewer than the nominal share pass.
  std::mt19937_64 random(41);
  int records = 0, significant = 0;
  for (int k = 0; k < 60; ++k) {
    const std::vector<std::vector<double>> smooth = {
        filtered(0.0, 0.0, random), filtered(0.97, 0.0, random), filtered(1.0, 0.0, random),
        resonance(0.3, 20.0, random), resonance(0.3, 120.0, random)};
    for (const std::vector<double>& error : smooth) {
      ++records;
      significant += least_p(error) <= 0.01 ? 1 : 0;
    }
  }
  EXPECT_LE(significant, 3) << "of " << records;
}

/// With a largest p of 1 the law of every place is evaluated, with a small one only where it may
/// matter.
TEST(SpectralLine, ALargestPLeavesTheMoreSignificantLinesAsTheyAre) {
  std::mt19937_64 random(43);
  std::size_t left = 0, left_out = 0;
  for (int k = 0; k < 40; ++k) {
    for (const std::vector<double>& error :
         {filtered(0.9, 0.0, random), resonance(0.02, 40.0, random),
          resonance(0.08, 150.0, random)}) {
      const LineSpectrum spectrum(error, 1.0);
      const std::vector<SpectralLine> all = spectrum.lines(1.0);
      for (const double largest_p : {1e-2, 1e-6}) {
        const std::vector<SpectralLine> found = spectrum.lines(largest_p);
        ASSERT_LE(found.size(), all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
          const bool significant = all[i].p <= spectrum.bands() * largest_p && all[i].p < 1.0;
          (significant ? left : left_out) += 1;
          if (!significant) continue;
          ASSERT_LT(i, found.size());
          EXPECT_EQ(found[i].frequency_hz, all[i].frequency_hz);
          EXPECT_EQ(found[i].p, all[i].p);
          EXPECT_EQ(found[i].height, all[i].height);
        }
      }
    }
  }
  EXPECT_GT(left, 50U);
  EXPECT_GT(left_out, 50U);
}

TEST(SpectralLine, LimitCyclesThatWanderShowOne) {
  std::mt19937_64 random(42);
  int found = 0;
  constexpr int kRecords = 60;
  for (int k = 0; k < kRecords; ++k) {
    const double period = std::exp(tests::uniform(std::log(10.0), std::log(200.0), random));
    const tests::Course course =
        tests::draw_course(kWindow, period, tests::uniform(0.0, 0.5, random), random);
    const LineSpectrum spectrum(tests::draw_error(course, period, 0, 0.5, kWindow, random), 2.0);
    const std::vector<SpectralLine> lines = spectrum.lines(0.01);
    if (lines.empty() || lines.front().p > 0.01) continue;
    ++found;
    EXPECT_NEAR(lines.front().frequency_hz * period * 2.0, 1.0, 0.1);
  }
  EXPECT_GE(found, 57);
}

TEST(SpectralLine, ShareIsThatOfTheVariance) {
  std::mt19937_64 random(43);
  const tests::Course course = tests::draw_course(kWindow, 40.0, 0.05, random);
  const LineSpectrum spectrum(tests::draw_error(course, 40.0, 0, 0.5, kWindow, random), 1.0);
  // A cosine of amplitude 1 beside noise of variance 1/4.
  EXPECT_NEAR(spectrum.share(1.0 / 40.0), 0.5 / 0.75, 0.08);
  EXPECT_EQ(spectrum.share(1.0 / 9.0), 0.0);
}

/// A tall line and faint noise behind it: powers from 1 to 1e-12, none of which is lost in the sum.
TEST(SpectralLine, SharesAreThoseOfThePeriodogram) {
  std::mt19937_64 random(46);
  for (const std::size_t samples : {256U, 1000U, 4095U, 4096U}) {
    std::vector<double> error(samples);
    for (std::size_t k = 0; k < samples; ++k)
      error[k] = std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / 16.0) +
                 1e-5 * hos::normal_draw(random);
    const Periodogram exact = hann_periodogram(error, samples);
    const LineSpectrum spectrum(error, 1.0);
    const auto bin = [&](double hz) {
      return static_cast<std::size_t>(
          std::round(hz * static_cast<double>(samples) * exact.stretch));
    };
    const auto sum = [&](std::size_t first, std::size_t last) {
      double power = 0.0;
      for (std::size_t k = first; k <= std::min(last, exact.power.size() - 1); ++k)
        power += exact.power[k];
      return power;
    };
    const double total = sum(1, exact.power.size());
    for (double hz = 0.01; hz < 0.5; hz += 0.00137) {
      const double share = sum(bin(0.5 * hz), bin(1.5 * hz)) / total;
      EXPECT_NEAR(spectrum.share_about(hz) / share, 1.0, 1e-3) << samples << ' ' << hz;
    }
  }
}

TEST(SpectralLine, GapsAndUnitsDoNotMatter) {
  std::mt19937_64 random(44);
  const tests::Course course = tests::draw_course(kWindow, 40.0, 0.1, random);
  std::vector<double> error = tests::draw_error(course, 40.0, 0, 0.5, kWindow, random);
  const double whole = least_p(error);
  for (const double unit : {1e6, 1e-30, 1e30}) {
    std::vector<double> scaled = error;
    for (double& value : scaled) value *= unit;
    EXPECT_NEAR(std::log(least_p(scaled)), std::log(whole), 1e-6 * std::abs(std::log(whole)))
        << unit;
  }
  for (std::size_t k = 1000; k < 1200; ++k) error[k] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LE(least_p(error), 1e-6);
}

TEST(SpectralLine, NothingIsSaidOfWhatIsTooShortOrStill) {
  const std::vector<double> still(kWindow, 3.0);
  EXPECT_TRUE(LineSpectrum(still, 1.0).lines(1.0).empty());
  EXPECT_EQ(LineSpectrum(still, 1.0).bands(), 0.0);
  EXPECT_EQ(LineSpectrum(still, 1.0).share(0.1), 0.0);
  EXPECT_TRUE(LineSpectrum({}, 1.0).lines(1.0).empty());
  std::mt19937_64 random(45);
  const LineSpectrum spectrum(filtered(0.0, 0.0, random), 1.0);
  EXPECT_EQ(spectrum.evidence(0.4).front(), 0.0) << "below 3.5 samples a period";
  EXPECT_EQ(spectrum.evidence(4.0 / 4096.0).front(), 0.0) << "fewer than eight periods";
}

}  // namespace
}  // namespace loopscope::core::plant
