#include "core/hos/bicoherence/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "core/hos/analyse.hpp"
#include "core/hos/kernels/principal_domain.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

constexpr std::size_t kPaperSegments = 127;

/// Zero but for the given values.
std::vector<double> surface(std::initializer_list<std::pair<Bifrequency, double>> values) {
  const PrincipalDomain domain(128);
  std::vector<double> bic2(domain.size());
  for (const auto& [at, value] : values) {
    bic2[domain.index(at)] = value;
  }
  return bic2;
}

TEST(HosPeaks, LevelIsTheBonferroniQuantileOfTheExponential) {
  EXPECT_NEAR(peak_level(127, 1024, 0.05), std::log(1024.0 / 0.05) / 127.0, 1e-15);
}

TEST(HosPeaks, AreSortedAndInCyclesPerSample) {
  const auto peaks = find_peaks(surface({{{20, 10}, 0.3}, {{40, 16}, 0.8}}), kPaperSegments, {});
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_EQ(peaks[0].f1, 40.0 / 128.0);
  EXPECT_EQ(peaks[0].f2, 16.0 / 128.0);
  EXPECT_EQ(peaks[0].bic2, 0.8);
  EXPECT_FALSE(peaks[0].p.has_value());
  EXPECT_EQ(peaks[1].f1, 20.0 / 128.0);
}

TEST(HosPeaks, WithinTheMainLobeOnlyTheStrongestCounts) {
  // Four bins either way: two cycles per segment of 64 in a DFT of 128.
  const auto peaks =
      find_peaks(surface({{{30, 10}, 0.8}, {{34, 14}, 0.5}, {{30, 15}, 0.4}}), kPaperSegments, {});
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_EQ(peaks[1].f2, 15.0 / 128.0);
}

TEST(HosPeaks, AShoulderIsNoPeak) {
  // A ridge that falls away from (20, 10) beyond the lobe.
  auto bic2 = surface({});
  const PrincipalDomain domain(128);
  for (std::size_t k1 = 20; k1 <= 30; ++k1) {
    bic2[domain.index({k1, 10})] = 0.9 - 0.05 * static_cast<double>(k1 - 20);
  }
  EXPECT_EQ(find_peaks(bic2, kPaperSegments, {}).size(), 1U);
}

TEST(HosPeaks, BelowTheLevelThereAreNone) {
  const double level = peak_level(kPaperSegments, 1024, 0.05);
  EXPECT_TRUE(find_peaks(surface({{{20, 10}, 0.99 * level}}), kPaperSegments, {}).empty());
  EXPECT_EQ(find_peaks(surface({{{20, 10}, 1.01 * level}}), kPaperSegments, {}).size(), 1U);
}

TEST(HosPeaks, NoMoreThanAskedFor) {
  const auto bic2 = surface({{{20, 10}, 0.3}, {{40, 16}, 0.8}, {{50, 2}, 0.5}});
  EXPECT_EQ(find_peaks(bic2, kPaperSegments, {.max_peaks = 2}).size(), 2U);
  EXPECT_TRUE(find_peaks(bic2, kPaperSegments, {.max_peaks = 0}).empty());
}

TEST(HosPeaks, CornersOfTheDomainAreFound) {
  for (const Bifrequency corner : {Bifrequency{1, 1}, {63, 1}, {32, 32}}) {
    const auto peaks = find_peaks(surface({{corner, 0.5}}), kPaperSegments, {});
    ASSERT_EQ(peaks.size(), 1U);
    EXPECT_EQ(peaks[0].f1, static_cast<double>(corner.k1) / 128.0);
  }
}

bool has_peak_near(const std::vector<Peak>& peaks, double f1, double f2) {
  // A line in noise moves its bin by up to the half of the main lobe's half width.
  const double near = 1.0 / 64.0;
  return std::any_of(peaks.begin(), peaks.end(), [&](const Peak& peak) {
    return std::abs(peak.f1 - f1) <= near && std::abs(peak.f2 - f2) <= near;
  });
}

TEST(HosPeaks, OfThePapersTwoSinusoidsAreThePapers) {
  // Figure 3: (0.12, 0.12), (0.18, 0.12), (0.30, 0.12); its fourth, (0.30, 0.30), lies outside the
  // inner triangle. The weakest rises above the level in most records, not in all.
  constexpr int kRecords = 50;
  int found[3] = {};
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    const auto result = analyse(tests::two_sinusoids(seed, 0.05), Settings{});
    ASSERT_TRUE(result.has_value());
    found[0] += has_peak_near(result->peaks, 0.18, 0.12) ? 1 : 0;
    found[1] += has_peak_near(result->peaks, 0.30, 0.12) ? 1 : 0;
    found[2] += has_peak_near(result->peaks, 0.12, 0.12) ? 1 : 0;
  }
  std::printf("[  peaks   ] of %d records: (0.18, 0.12) %d, (0.30, 0.12) %d, (0.12, 0.12) %d\n",
              kRecords, found[0], found[1], found[2]);
  EXPECT_GE(found[0], 48);
  EXPECT_GE(found[1], 48);
  EXPECT_GE(found[2], 25);
}

}  // namespace
}  // namespace loopscope::core::hos
