#include "core/hos/coupling/quadratic_test.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/simulate/coloured_noise.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/core/hos/uniformity.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

TEST(HosQuadraticTest, MeasuresTheMeanOverTheTestableCells) {
  Bicoherence bicoherence(Settings{});
  const auto bic2 = bicoherence.estimate(tests::white_noise(1));
  const TestableCells cells(Settings{});
  double sum = 0.0;
  for (std::size_t i = 0; i < bic2.size(); ++i) {
    sum += cells.contains(bicoherence.domain().at(i)) ? bic2[i] : 0.0;
  }
  const QuadraticStatistics found = QuadraticTest(Settings{}).measure(bicoherence, bic2);
  EXPECT_NEAR(found.mean, 127.0 * sum / 714.0, 1e-12);
}

TEST(HosQuadraticTest, HoldsItsLevelsOnNoiseOfAnyColourAndOverlap) {
  const int records = tests::records(1500);
  for (const Settings& settings :
       {Settings{}, Settings{.overlap = 0.0}, Settings{.segment_length = 32, .dft_length = 64}}) {
    for (const double pole : {0.0, 0.95}) {
      const QuadraticTest test(settings);
      Bicoherence bicoherence(settings);
      std::vector<double> mean_p;
      std::vector<double> largest_p;
      for (int seed = 1; seed <= records; ++seed) {
        const auto bic2 =
            bicoherence.estimate(tests::first_order_noise(static_cast<std::uint64_t>(seed), pole));
        const QuadraticStatistics found = test.measure(bicoherence, bic2);
        mean_p.push_back(test.mean_p(found, bicoherence.segments()));
        largest_p.push_back(test.largest_p(found));
      }
      for (const double level : {0.05, 0.01}) {
        const double most = 1.4 * level + four_errors(level, records);
        EXPECT_LE(tests::share_below(mean_p, level), most) << pole;
        EXPECT_LE(tests::share_below(largest_p, level), most) << pole;
      }
      std::printf("overlap %.2f, segment %zu, pole %.2f: mean %.3f, largest %.3f at 5 %%\n",
                  settings.overlap, settings.segment_length, pole, tests::share_below(mean_p, 0.05),
                  tests::share_below(largest_p, 0.05));
    }
  }
}

/// Corrected p at the bins (29, 19) of the triple of frequencies 0.2266 + 0.1484.
double p_of_triple(bool coupled, std::uint64_t seed) {
  Bicoherence bicoherence(Settings{});
  (void)bicoherence.estimate(tests::triple(seed, 29.0 / 128.0, 19.0 / 128.0, coupled));
  return QuadraticTest(Settings{}).peak_p(bicoherence, {29, 19}).value();
}

TEST(HosQuadraticTest, PeakPTellsCoupledFromUncoupledLines) {
  int false_peaks = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    EXPECT_LT(p_of_triple(true, seed), 1e-6);
    false_peaks += p_of_triple(false, seed) < 0.05 ? 1 : 0;
  }
  EXPECT_LE(false_peaks, 4);
}

TEST(HosQuadraticTest, CellsThatShareALobeHaveNoP) {
  Bicoherence bicoherence(Settings{});
  (void)bicoherence.estimate(tests::white_noise(2));
  const QuadraticTest test{Settings{}};
  EXPECT_FALSE(test.peak_p(bicoherence, {20, 3}).has_value());
  EXPECT_FALSE(test.peak_p(bicoherence, {60, 4}).has_value());
  EXPECT_TRUE(test.peak_p(bicoherence, {20, 10}).has_value());
}

TEST(HosQuadraticTest, WithoutATestableCellSaysNothing) {
  const Settings settings{.segment_length = 16, .dft_length = 16};
  Bicoherence bicoherence(settings);
  const auto bic2 = bicoherence.estimate(tests::exponential_noise(3));
  const QuadraticTest test(settings);
  const QuadraticStatistics found = test.measure(bicoherence, bic2);
  EXPECT_EQ(found.mean, 1.0);
  EXPECT_EQ(found.largest, 0.0);
  EXPECT_EQ(test.mean_p(found, bicoherence.segments()), 1.0);
  EXPECT_NEAR(test.largest_p(found), 1.0, 1e-11);
}

TEST(HosQuadraticTest, TheLevelOfTheMeanIsGrantedToTheLargest) {
  const QuadraticTest test{Settings{}};
  const double gaussian = test.largest_p({1.0, 15.0});
  EXPECT_NEAR(gaussian / (0.62 * 714.0 * std::exp(-15.0)), 1.0, 1e-3);
  EXPECT_GT(test.largest_p({3.0, 15.0}), 100.0 * gaussian);
  EXPECT_DOUBLE_EQ(test.largest_p({0.8, 15.0}), gaussian);
}

}  // namespace
}  // namespace loopscope::core::hos
