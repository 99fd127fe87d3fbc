#include "core/loop/spectral_peak.hpp"

#include <functional>
#include <gtest/gtest.h>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;

SpectralPeak peak_of(const Series& series) {
  RealTransform transform(transform_length(series.size()));
  const RecordSpectrum spectrum(series, *signal::measure_spread(series), transform);
  return *find_spectral_peak(spectrum, {0.002, 0.125});
}

int clear_peaks(int records, const std::function<Series(Random&)>& draw) {
  int clear = 0;
  for (int record = 0; record < records; ++record) {
    Random random(static_cast<std::uint64_t>(record));
    if (peak_of(draw(random)).prominence >= kClearProminence) ++clear;
  }
  return clear;
}

TEST(SpectralPeak, SmoothSpectraHaveNone) {
  // Two in a hundred at most (MEASURED.md); with 100 records more than 7 happen once in a thousand.
  constexpr std::size_t kCount = 2048;
  EXPECT_LE(clear_peaks(100, [](Random& r) { return signals::white(r, kCount); }), 7);
  EXPECT_LE(clear_peaks(100, [](Random& r) { return signals::ar1(r, kCount, 0.9); }), 7);
  EXPECT_LE(clear_peaks(100, [](Random& r) { return signals::ar1(r, kCount, 1.0); }), 7);
}

TEST(SpectralPeak, FundamentalWinsOverHarmonics) {
  for (const auto kind : {signals::Wave::square, signals::Wave::triangle}) {
    Random random(1);
    const SpectralPeak peak = peak_of(signals::wave(random, 2048, kind, 80.0));
    EXPECT_NEAR(peak.frequency * 80.0, 1.0, 0.15);  // the width of the search band
    EXPECT_GT(peak.prominence, kClearProminence);
  }
}

TEST(SpectralPeak, StandsOutOfARandomWalk) {
  Random random(2);
  const Series line = signals::wave(random, 4096, signals::Wave::sine, 40.0);
  const Series both = signals::sum(line, signals::ar1(random, 4096, 1.0), 0.2);
  EXPECT_NEAR(peak_of(both).frequency * 40.0, 1.0, 0.15);
}

TEST(SpectralPeak, ShareAboveBackgroundIsThatOfTheLine) {
  // Variance 0.5 in a sinusoid; white noise of variance 1 leaves 2 * 0.075 of it in the band.
  Random random(3);
  const Series noise = signals::white(random, 4096);
  const Series line = signals::wave(random, 4096, signals::Wave::sine, 20.0);
  const Series both = signals::sum(line, noise, 1.0);
  RealTransform transform(transform_length(both.size()));
  const RecordSpectrum spectrum(both, *signal::measure_spread(both), transform);
  const double share = share_above_background(spectrum, 0.05, {0.025, 0.1});
  EXPECT_NEAR(share, 0.5 / (0.5 + 0.15), 0.05);
}

}  // namespace
}  // namespace loopscope::core::loop
