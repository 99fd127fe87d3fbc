#include "core/hos/literature/bispectrum_indirect.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/literature/bispectrum_direct.hpp"
#include "tests/core/hos/bispectrum_of_linear_process.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

// Windowed to half a segment the estimate varies less than the direct one.
constexpr std::size_t kIndirectLength = 1 << 16;
constexpr double kIndirectTolerance = 0.2;

TEST(HosBispectrumIndirect, IsTheThirdMomentOnWhiteNoise) {
  const auto bispectrum =
      bispectrum_indirect(tests::exponential_noise(31, kIndirectLength), Settings{});
  tests::expect_near_linear(bispectrum, {1.0}, Settings{}, kIndirectTolerance);
}

TEST(HosBispectrumIndirect, FollowsTheTransferFunctionOfALinearProcess) {
  const std::vector<double> taps = {1.0, -0.6, 0.3};
  const auto signal = tests::moving_average(tests::exponential_noise(32, kIndirectLength), taps);
  tests::expect_near_linear(bispectrum_indirect(signal, Settings{}), taps, Settings{},
                            kIndirectTolerance);
}

TEST(HosBispectrumIndirect, AgreesWithTheDirectMethodOnTheSameSamples) {
  // Both estimate the same smooth function. The direct one has a relative standard error of
  // sqrt((sum w^2)^3 / K) / (sum w^3 skewness) = sqrt(24.4^3 / 2047) / (20.3 * 2) = 0.066 at every
  // bifrequency; the indirect one smooths more and strays less, so that the root mean square of
  // their difference stays below twice that. Bins near zero frequency are left out: there the
  // direct method has lost the means of its segments.
  const std::vector<double> taps = {1.0, -0.6, 0.3};
  const auto signal = tests::moving_average(tests::exponential_noise(33, kIndirectLength), taps);
  const auto direct = bispectrum_direct(signal, Settings{});
  const auto indirect = bispectrum_indirect(signal, Settings{});
  ASSERT_EQ(direct.size(), indirect.size());
  const PrincipalDomain domain(128);
  double difference = 0.0;
  double count = 0.0;
  for (std::size_t i = domain.row_begin(5); i < direct.size(); ++i) {
    difference += std::norm(direct[i] / indirect[i] - 1.0);
    count += 1.0;
  }
  EXPECT_LT(std::sqrt(difference / count), 2.0 * 0.066);
}

TEST(HosBispectrumIndirect, TimeReversalConjugates) {
  auto signal = tests::exponential_noise(34);
  const auto forward = bispectrum_indirect(signal, Settings{});
  std::reverse(signal.begin(), signal.end());
  const auto backward = bispectrum_indirect(signal, Settings{});
  for (std::size_t i = 0; i < forward.size(); ++i) {
    EXPECT_LT(std::abs(backward[i] - std::conj(forward[i])), 1e-10);
  }
}

TEST(HosBispectrumIndirect, MissingSamplesLeaveTheLevel) {
  auto signal = tests::exponential_noise(35, kIndirectLength);
  for (std::size_t k = 0; k < signal.size(); k += 50) {
    signal[k] = std::nan("");
  }
  tests::expect_near_linear(bispectrum_indirect(signal, Settings{}), {1.0}, Settings{},
                            kIndirectTolerance);
}

TEST(HosBispectrumIndirect, EmptyWithoutASample) {
  EXPECT_TRUE(bispectrum_indirect({}, Settings{}).empty());
  EXPECT_TRUE(bispectrum_indirect(std::vector<double>(100, std::nan("")), Settings{}).empty());
  EXPECT_THROW((void)bispectrum_indirect({}, {.overlap = 1.0}), std::invalid_argument);
}

TEST(HosParzen, FallsFromOneToZeroWithoutAStep) {
  EXPECT_EQ(parzen(0, 32), 1.0);
  EXPECT_EQ(parzen(32, 32), 0.0);
  EXPECT_EQ(parzen(40, 32), 0.0);
  EXPECT_NEAR(parzen(16, 32), 0.25, 1e-15);  // both branches meet here
  for (std::ptrdiff_t lag = 1; lag <= 32; ++lag) {
    EXPECT_LT(parzen(lag, 32), parzen(lag - 1, 32));
    EXPECT_EQ(parzen(lag, 32), parzen(-lag, 32));
  }
}

}  // namespace
}  // namespace loopscope::core::hos
