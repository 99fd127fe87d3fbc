#include "core/hos/literature/bispectrum_direct.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/hos/kernels/principal_domain.hpp"
#include "tests/core/hos/bispectrum_of_linear_process.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

// Every bifrequency has the relative standard error sqrt((sum w^2)^3 / K) / (sum w^3 skewness) =
// sqrt(24.4^3 / 8191) / (20.3 * 2) = 0.033; the tolerance is six of them, for the largest error of
// a thousand bifrequencies.
constexpr std::size_t kDirectLength = 1 << 18;
constexpr double kDirectTolerance = 0.2;

TEST(HosBispectrumDirect, IsTheThirdMomentOnWhiteNoise) {
  const auto bispectrum =
      bispectrum_direct(tests::exponential_noise(21, kDirectLength), Settings{});
  tests::expect_near_linear(bispectrum, {1.0}, Settings{}, kDirectTolerance);
}

TEST(HosBispectrumDirect, FollowsTheTransferFunctionOfALinearProcess) {
  const std::vector<double> taps = {1.0, -0.6, 0.3};
  const auto signal = tests::moving_average(tests::exponential_noise(22, kDirectLength), taps);
  tests::expect_near_linear(bispectrum_direct(signal, Settings{}), taps, Settings{},
                            kDirectTolerance);
}

TEST(HosBispectrumDirect, TimeReversalConjugates) {
  auto signal = tests::exponential_noise(23);
  const auto forward = bispectrum_direct(signal, Settings{});
  std::reverse(signal.begin(), signal.end());
  const auto backward = bispectrum_direct(signal, Settings{});
  for (std::size_t i = 0; i < forward.size(); ++i) {
    EXPECT_LT(std::abs(backward[i] - std::conj(forward[i])), 1e-11);
  }
}

TEST(HosBispectrumDirect, HasTheUnitOfTheSignalCubed) {
  const auto signal = tests::exponential_noise(24);
  const auto one = bispectrum_direct(signal, Settings{});
  const auto ten = bispectrum_direct(tests::affine(signal, -10.0, 3.0), Settings{});
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_LT(std::abs(ten[i] + 1000.0 * one[i]), 1e-8);
  }
}

TEST(HosBispectrumDirect, EmptyWithoutASegment) {
  EXPECT_TRUE(bispectrum_direct(tests::white_noise(1, 63), Settings{}).empty());
  EXPECT_EQ(bispectrum_direct(tests::white_noise(1, 64), Settings{}).size(), 1024U);
  EXPECT_THROW((void)bispectrum_direct({}, {.alpha = 2.0}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::hos
