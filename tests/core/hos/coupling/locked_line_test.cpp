#include "core/hos/coupling/locked_line.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>
#include <vector>

#include "core/hos/slow_look.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

Spectra spectra_of(const std::vector<double>& signal, const Settings& settings = {}) {
  Spectra spectra(settings);
  spectra.compute(signal);
  return spectra;
}

std::vector<double> sine(double period, double snr_db, std::uint64_t seed) {
  return simulate::limit_cycle({simulate::WaveShape::sine, period, snr_db, 0.0}, 4096, seed);
}

/// Share of records of white noise in which a line is seen.
double false_lines(const Settings& settings, std::size_t samples, int records) {
  Spectra spectra(settings);
  double share = 0.0;
  for (int seed = 1; seed <= records; ++seed) {
    spectra.compute(tests::white_noise(static_cast<std::uint64_t>(seed), samples));
    share += has_locked_line(spectra) ? 1.0 / records : 0.0;
  }
  return share;
}

TEST(HosLockedLine, WhiteNoiseHasOneInAThousandRecordsAtMost) {
  const int records = tests::records(4000);
  Settings flat;
  flat.overlap = 0.0;
  const double limit = 1e-3 + four_errors(1e-3, records);
  // Slow settings too: segments that overlap by three quarters add up in phase at some bins.
  for (const auto& [settings, samples] :
       {std::pair{Settings{}, 4096U}, std::pair{flat, 4096U}, std::pair{Settings{}, 544U},
        std::pair{slow_settings({}), 504U}, std::pair{slow_settings({}), 144U}}) {
    const double share = false_lines(settings, samples, records);
    std::printf("| overlap %.2f | %u samples | %.2f %% |\n", settings.overlap, samples,
                100.0 * share);
    EXPECT_LE(share, limit) << settings.overlap << ' ' << samples;
  }
}

TEST(HosLockedLine, IsTheNumberOfSegmentsForALineAlone) {
  Spectra spectra{Settings{.overlap = 0.0}};
  // Period 16 divides the hop of 64: all segments are the same.
  std::vector<double> line(4096);
  for (std::size_t n = 0; n < line.size(); ++n) {
    line[n] = std::cos(2.0 * std::numbers::pi * static_cast<double>(n) / 16.0);
  }
  spectra.compute(line);
  EXPECT_NEAR(line_lock(spectra), 64.0, 1e-6);
}

TEST(HosLockedLine, SeesLinesWhosePeriodDividesTheHop) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (const double period : {16.0, 32.0}) {
      EXPECT_TRUE(has_locked_line(spectra_of(sine(period, 20.0, seed)))) << period << ' ' << seed;
    }
    EXPECT_FALSE(has_locked_line(spectra_of(sine(33.4, 20.0, seed)))) << seed;
    EXPECT_FALSE(has_locked_line(spectra_of(sine(16.7, 20.0, seed)))) << seed;
  }
}

TEST(HosLockedLine, DoesNotDependOnScaleOrGaps) {
  auto line = sine(16.0, 20.0, 3);
  const double before = line_lock(spectra_of(line));
  EXPECT_NEAR(line_lock(spectra_of(tests::affine(line, 1e200, 0.0))) / before, 1.0, 1e-9);
  for (std::size_t n = 1000; n < 2000; ++n) line[n] = std::nan("");
  EXPECT_TRUE(has_locked_line(spectra_of(line)));
}

TEST(HosLockedLine, NothingIsLockedInAConstantOrInNothing) {
  EXPECT_EQ(line_lock(spectra_of(std::vector<double>(4096, 0.1))), 0.0);
  EXPECT_EQ(line_lock(spectra_of({})), 0.0);
}

}  // namespace
}  // namespace loopscope::core::hos
