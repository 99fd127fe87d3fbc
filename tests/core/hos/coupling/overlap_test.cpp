#include "core/hos/coupling/overlap.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/coupling/testable_cells.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

TEST(HosOverlap, OfThePapersSettingsAddsTwoCubesOfItsCorrelation) {
  const Overlap overlap{Settings{}};
  ASSERT_EQ(overlap.lags(), 1U);
  EXPECT_DOUBLE_EQ(overlap.correlation()[0], 1.0);
  // The paper's window has no zero at either end, so that 64 samples share a little more.
  EXPECT_NEAR(overlap.correlation()[1], 0.1771, 1e-4);
  EXPECT_NEAR(overlap.mean(), 1.0 + 2.0 * std::pow(overlap.correlation()[1], 3.0), 1e-12);
}

TEST(HosOverlap, OfAPeriodicHannWindowIsASixth) {
  const Overlap overlap{{.window = WindowShape::hann_periodic}};
  EXPECT_NEAR(overlap.correlation()[1], 1.0 / 6.0, 1e-3);
  EXPECT_NEAR(overlap.mean(), 1.0 + 2.0 / 216.0, 1e-4);
}

TEST(HosOverlap, SettingsOutOfRangeThrow) {
  EXPECT_THROW(Overlap({.dft_length = 7}), std::invalid_argument);
}

TEST(HosOverlap, WithoutOverlapSegmentsShareNothing) {
  const Overlap overlap{{.overlap = 0.0}};
  EXPECT_EQ(overlap.lags(), 0U);
  EXPECT_DOUBLE_EQ(overlap.mean(), 1.0);
}

TEST(HosOverlap, WithoutTaperAndPaddingBinsShareNothing) {
  const Overlap overlap{{.overlap = 0.0, .window = WindowShape::rectangular, .dft_length = 64}};
  EXPECT_NEAR(overlap.correlated_cells(), 1.0, 1e-12);
}

TEST(HosOverlap, OfARectangleIsTheSharedShare) {
  const Overlap overlap{{.overlap = 0.75, .window = WindowShape::rectangular, .dft_length = 64}};
  ASSERT_EQ(overlap.lags(), 3U);
  EXPECT_NEAR(overlap.correlation()[1], 0.75, 1e-12);
  EXPECT_NEAR(overlap.correlation()[3], 0.25, 1e-12);
  EXPECT_NEAR(overlap.mean(), 1.0 + 2.0 * (0.75 * 0.75 * 0.75 + 0.125 + 0.25 * 0.25 * 0.25), 1e-12);
}

/// K bic2 averaged over the testable cells of white noise: mean and variance over records.
struct MomentsOfMeans {
  double mean = 0.0;
  double variance = 0.0;
};

MomentsOfMeans of_white_noise(const Settings& settings, int records) {
  Bicoherence bicoherence(settings);
  const TestableCells cells(settings);
  double sum = 0.0;
  double square = 0.0;
  for (int seed = 1; seed <= records; ++seed) {
    const auto bic2 = bicoherence.estimate(tests::white_noise(static_cast<std::uint64_t>(seed)));
    double mean = 0.0;
    for (std::size_t i = 0; i < bic2.size(); ++i) {
      mean += cells.contains(bicoherence.domain().at(i)) ? bic2[i] : 0.0;
    }
    mean *= static_cast<double>(bicoherence.segments()) / static_cast<double>(cells.count());
    sum += mean / records;
    square += mean * mean / records;
  }
  return {sum, square - sum * sum};
}

TEST(HosOverlap, GivesMeanAndSpreadOfWhiteNoise) {
  const int records = tests::records(1500);
  for (const Settings& settings :
       {Settings{}, Settings{.overlap = 0.0}, Settings{.window = WindowShape::hamming},
        Settings{.segment_length = 32, .overlap = 0.75, .dft_length = 64}}) {
    const Overlap overlap(settings);
    const TestableCells cells(settings);
    const MomentsOfMeans found = of_white_noise(settings, records);
    const double expected =
        std::sqrt(overlap.correlated_cells() / static_cast<double>(cells.count()));
    EXPECT_NEAR(found.mean, overlap.mean(),
                0.015 + 4.0 * expected / std::sqrt(static_cast<double>(records)));
    // Four standard errors of a standard deviation, and the few per cent that normalising by the
    // cells' own powers takes away.
    EXPECT_NEAR(std::sqrt(found.variance) / expected, 0.97, 0.06 + 2.83 / std::sqrt(records));
    std::printf("overlap %.2f: mean %.4f (G %.4f), std %.4f (%.4f)\n", settings.overlap, found.mean,
                overlap.mean(), std::sqrt(found.variance), expected);
  }
}

TEST(HosOverlap, IsKeptPerWhatItDependsOn) {
  const Settings settings{.overlap = 0.59375};
  const Overlap& kept = Overlap::of(settings);
  const Overlap fresh(settings);
  EXPECT_EQ(kept.mean(), fresh.mean());
  EXPECT_EQ(kept.correlated_cells(), fresh.correlated_cells());
  EXPECT_EQ(kept.correlation(), fresh.correlation());
  EXPECT_EQ(&Overlap::of({.overlap = 0.59375, .alpha = 0.01}), &kept);
  EXPECT_NE(&Overlap::of({.overlap = 0.5}), &kept);
  EXPECT_THROW((void)Overlap::of({.dft_length = 7}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::hos
