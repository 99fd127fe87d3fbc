#include "core/loop/record_spectrum.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Series;

Series sine(std::size_t count, double period) {
  Series series(count);
  for (std::size_t k = 0; k < count; ++k) {
    series[k] = std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / period);
  }
  return series;
}

signal::Samples cut(const Series& series, Band band, std::size_t longest_bridge = 0) {
  RealTransform transform(transform_length(series.size()));
  return RecordSpectrum(series, *signal::measure_spread(series), transform)
      .component(band, longest_bridge);
}

/// Largest difference away from the ends, where the continued record takes over.
double largest_difference(const Series& left, const Series& right, std::size_t margin) {
  double largest = 0.0;
  for (std::size_t k = margin; k + margin < left.size(); ++k) {
    largest = std::max(largest, std::abs(left[k] - right[k]));
  }
  return largest;
}

TEST(RecordSpectrum, WholeBandGivesBackTheRecordWithoutItsLine) {
  // A sine of whole periods has next to no slope of its own; the line of slope 0.01 has to go. The
  // sine's least-squares slope is 6 / (pi N periods) per sample, 0.04 over half the record here.
  const Series expected = sine(1000, 20.0);
  Series series = expected;
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += 5.0 + 0.01 * static_cast<double>(k);
  EXPECT_LT(largest_difference(cut(series, {0.0, 1.0}), expected, 0), 0.05);
}

/// The mirror image turns the slope s of the record's end into a kink of 2 s. In a band from w1
/// (radians per sample) a kink q leaves at most q / (pi w1^2 t) at a distance of t samples.
double kink_bound(double slope, double lowest_frequency, double distance) {
  const double w1 = 2.0 * std::numbers::pi * lowest_frequency;
  return 2.0 * slope / (std::numbers::pi * w1 * w1 * distance);
}

TEST(RecordSpectrum, KeepsTheBandAndDropsTheRest) {
  const Series slow = sine(2000, 400.0);
  const Series wanted = sine(2000, 50.0);
  const Series fast = sine(2000, 5.0);
  const Series all = signals::sum(signals::sum(slow, wanted, 1.0), fast, 1.0);
  const double slope_in_band = 2.0 * std::numbers::pi / 50.0;
  EXPECT_LT(largest_difference(cut(all, {0.01, 0.04}), wanted, 200),
            kink_bound(slope_in_band, 0.01, 200.0));
}

TEST(RecordSpectrum, IsNotDisturbedByALargeDrift) {
  // The parabola rises by a hundred amplitudes. Without its line it ends 17 above its mean with a
  // slope of 0.05; padded with zeros, that step alone would leave 17 / (pi w1 t) = 0.34 here.
  const Series wanted = sine(2000, 20.0);
  Series drifting = wanted;
  for (std::size_t k = 0; k < drifting.size(); ++k) {
    drifting[k] += 100.0 * std::pow(static_cast<double>(k) / 2000.0, 2.0);
  }
  const double slope = 0.05 + 2.0 * std::numbers::pi / 20.0;
  EXPECT_LT(largest_difference(cut(drifting, {0.025, 0.1}), wanted, 100),
            kink_bound(slope, 0.025, 100.0));
}

TEST(RecordSpectrum, BridgesShortGapsAndLeavesLongOnesMissing) {
  Series series = sine(1000, 100.0);
  const Series whole = series;
  for (std::size_t k = 300; k < 305; ++k) series[k] = std::nan("");
  for (std::size_t k = 600; k < 650; ++k) series[k] = std::nan("");
  const auto part = cut(series, {0.005, 0.02}, 10);
  EXPECT_NEAR(part[302], whole[302], 0.1);
  EXPECT_TRUE(std::isnan(part[600]));
  EXPECT_TRUE(std::isnan(part[649]));
  EXPECT_FALSE(std::isnan(part[650]));
}

TEST(RecordSpectrum, WhiteNoiseIsFlat) {
  signals::Random random(3);
  double low = 0.0;
  double high = 0.0;
  for (int record = 0; record < 20; ++record) {
    const Series series = signals::white(random, 1024);
    RealTransform transform(transform_length(series.size()));
    const RecordSpectrum spectrum(series, *signal::measure_spread(series), transform);
    const std::size_t half = spectrum.power().size() / 2;
    for (std::size_t i = 2; i < half; ++i) low += spectrum.power()[i];
    for (std::size_t i = half; i + 2 < 2 * half; ++i) high += spectrum.power()[i];
  }
  // 20 records of 256 independent bins per half: 1.4 % standard deviation each.
  EXPECT_NEAR(low / high, 1.0, 0.06);
}

}  // namespace
}  // namespace loopscope::core::loop
