#include "core/hos/transforms/window.hpp"

#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace loopscope::core::hos {
namespace {

constexpr double kRounding = 1e-14;

/// Magnitude of the window's spectrum at `cycles` per segment, relative to zero frequency.
double leakage(const std::vector<double>& window, double cycles) {
  std::complex<double> sum;
  for (std::size_t n = 0; n < window.size(); ++n) {
    const double turn = cycles * static_cast<double>(n) / static_cast<double>(window.size());
    sum += std::polar(window[n], -2.0 * std::numbers::pi * turn);
  }
  return std::abs(sum) / std::accumulate(window.begin(), window.end(), 0.0);
}

TEST(HosWindow, InteriorHannHasNoZeroAndIsSymmetric) {
  const auto w = make_window(WindowShape::hann, 64);
  for (std::size_t n = 0; n < 64; ++n) {
    EXPECT_GT(w[n], 0.0);
    EXPECT_NEAR(w[n], w[63 - n], kRounding);
  }
  // w(1) of the formula: (1 - cos(2 pi / 65)) / 2 = sin^2(pi / 65).
  EXPECT_NEAR(w[0], std::pow(std::sin(std::numbers::pi / 65.0), 2), kRounding);
  // The weights sum to (N + 1) / 2: the cosine over a whole period of N + 1 points sums to zero.
  EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), 32.5, 1e-12);
}

TEST(HosWindow, PeriodicHannIsZeroAtOneEndAndOneInTheMiddle) {
  const auto w = make_window(WindowShape::hann_periodic, 64);
  EXPECT_NEAR(w[0], 0.0, kRounding);
  EXPECT_NEAR(w[32], 1.0, kRounding);
}

TEST(HosWindow, HammingEndsAtEightPercent) {
  const auto w = make_window(WindowShape::hamming, 64);
  EXPECT_NEAR(w.front(), 0.08, kRounding);
  EXPECT_NEAR(w.back(), 0.08, kRounding);
}

TEST(HosWindow, MainLobeEndsWhereItSays) {
  for (const WindowShape shape : {WindowShape::hann, WindowShape::hann_periodic,
                                  WindowShape::hamming, WindowShape::rectangular}) {
    const auto w = make_window(shape, 64);
    const double edge = main_lobe_half_width(shape);
    // The symmetric windows have their zero a few percent of a bin away.
    EXPECT_LT(leakage(w, edge), 0.012) << name(shape);
    EXPECT_GT(leakage(w, edge - 0.5), 0.1) << name(shape);
  }
}

}  // namespace
}  // namespace loopscope::core::hos
