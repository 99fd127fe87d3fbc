#include "core/hos/bicoherence/moments.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

TEST(HosMoments, OfAFewSamplesByHand) {
  // Deviations -2 -1 -1 4: m2 = 22/4, m3 = 54/4, m4 = 274/4.
  const Moments found = moments(std::vector<double>{1.0, 2.0, 2.0, 7.0});
  EXPECT_NEAR(found.skewness, 13.5 / std::pow(5.5, 1.5), 1e-14);
  EXPECT_NEAR(found.excess_kurtosis, 68.5 / (5.5 * 5.5) - 3.0, 1e-14);
}

TEST(HosMoments, ASymmetricTwoValuedRecordHasTheLeastKurtosis) {
  const Moments found = moments(std::vector<double>{5.0, 7.0, 7.0, 5.0});
  EXPECT_NEAR(found.skewness, 0.0, 1e-14);
  EXPECT_NEAR(found.excess_kurtosis, -2.0, 1e-14);
}

TEST(HosMoments, OfGaussianAndExponentialNoise) {
  // Standard errors with N = 4096: Gaussian sqrt(6/N) = 0.038 and sqrt(24/N) = 0.077.
  const Moments gaussian = moments(tests::white_noise(51));
  EXPECT_NEAR(gaussian.skewness, 0.0, 4.0 * 0.038);
  EXPECT_NEAR(gaussian.excess_kurtosis, 0.0, 4.0 * 0.077);
  // Skewness 2 and excess 6; estimated over 2^18 samples within a few percent.
  const Moments exponential = moments(tests::exponential_noise(52, 1 << 18));
  EXPECT_NEAR(exponential.skewness, 2.0, 0.1);
  EXPECT_NEAR(exponential.excess_kurtosis, 6.0, 0.9);
}

TEST(HosMoments, ScaleAndOffsetChangeNothingButTheSign) {
  const auto x = tests::exponential_noise(53);
  const Moments expected = moments(x);
  for (const double gain : {1e-300, 3.0, 1e300}) {
    const Moments found = moments(tests::affine(x, -gain, 2.0 * gain));
    EXPECT_NEAR(found.skewness, -expected.skewness, 1e-10);
    EXPECT_NEAR(found.excess_kurtosis, expected.excess_kurtosis, 1e-10);
  }
}

TEST(HosMoments, MissingSamplesAreLeftOut) {
  const Moments found = moments(std::vector<double>{1.0, std::nan(""), 2.0, 2.0,
                                                    std::numeric_limits<double>::infinity(), 7.0});
  EXPECT_NEAR(found.skewness, 13.5 / std::pow(5.5, 1.5), 1e-14);
}

TEST(HosMoments, ZeroWithoutVariance) {
  for (const auto& x : {std::vector<double>{}, std::vector<double>{std::nan("")},
                        std::vector<double>(4096, 0.1), std::vector<double>(4096, 0.0)}) {
    EXPECT_EQ(moments(x).skewness, 0.0);
    EXPECT_EQ(moments(x).excess_kurtosis, 0.0);
  }
}

}  // namespace
}  // namespace loopscope::core::hos
