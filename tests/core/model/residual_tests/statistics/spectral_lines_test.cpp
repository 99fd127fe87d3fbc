#include "core/model/residual_tests/statistics/spectral_lines.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

using tests::add_sinusoid;
using tests::Series;

TEST(SpectralLines, ThreeLinesWithTheirPeriods) {
  Series signal = tests::white(tests::White::gaussian, 4096, 1);
  add_sinusoid(signal, 20.3, 3.0);
  add_sinusoid(signal, 100.7, 2.0);
  add_sinusoid(signal, 47.1, 1.0);
  const LineSearch found = find_lines(signal);
  ASSERT_EQ(found.lines.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const SpectralLine& line = found.lines[i];
    const double period =
        line.period_samples < 30.0 ? 20.3 : (line.period_samples < 70.0 ? 47.1 : 100.7);
    const double amplitude = period == 20.3 ? 3.0 : (period == 47.1 ? 1.0 : 2.0);
    EXPECT_NEAR(line.period_samples / period, 1.0, 0.003);
    EXPECT_NEAR(line.amplitude / amplitude, 1.0, 0.15);
  }
}

TEST(SpectralLines, PeriodsAreExactWithoutNoise) {
  for (const double period : {7.77, 33.3, 250.0, 600.0}) {
    Series signal(4096, 5.0);
    add_sinusoid(signal, period, 1.0);
    const LineSearch found = find_lines(signal);
    ASSERT_FALSE(found.lines.empty()) << period;
    EXPECT_NEAR(found.lines[0].period_samples / period, 1.0, 0.003) << period;
  }
}

TEST(SpectralLines, MissingSamplesDoNotMoveALine) {
  Series signal = tests::white(tests::White::gaussian, 4096, 2);
  add_sinusoid(signal, 60.0, 1.0);
  for (std::size_t k = 0; k < signal.size(); ++k)
    if (k % 3 == 0 || (k > 1000 && k < 1400)) signal[k] = std::numeric_limits<double>::quiet_NaN();
  const LineSearch found = find_lines(signal);
  ASSERT_FALSE(found.lines.empty());
  EXPECT_NEAR(found.lines[0].period_samples, 60.0, 0.2);
}

TEST(SpectralLines, ARandomWalkHasNone) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Series walk = tests::white(tests::White::gaussian, 2000, seed);
    for (std::size_t k = 1; k < walk.size(); ++k) walk[k] += walk[k - 1];
    found += find_lines(walk).p <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(found, 14);  // 5 and four standard deviations
}

TEST(SpectralLines, NothingInAConstantOrAShortRecord) {
  EXPECT_EQ(find_lines(Series(1000, 3.0)).p, 1.0);
  EXPECT_EQ(find_lines(Series(10, 3.0)).p, 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
