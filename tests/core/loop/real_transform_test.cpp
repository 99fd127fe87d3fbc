#include "core/loop/real_transform.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

TEST(FastLength, IsTheSmallestOfItsKind) {
  EXPECT_EQ(fast_length(1), 4U);
  EXPECT_EQ(fast_length(17), 20U);
  EXPECT_EQ(fast_length(21), 24U);
  EXPECT_EQ(fast_length(25), 32U);
  EXPECT_EQ(fast_length(1127), 1280U);
  EXPECT_EQ(fast_length(6144), 6144U);
}

TEST(FastLength, NeverFallsShortAndWastesAtMostAThird) {
  for (std::size_t least = 16; least < 3000; ++least) {
    const std::size_t length = fast_length(least);
    EXPECT_GE(length, least);
    EXPECT_LE(3 * length, 4 * least + 12);
    EXPECT_EQ(length % 4, 0U);
  }
}

TEST(RealTransform, InverseUndoesForward) {
  signals::Random random(1);
  const auto series = signals::white(random, 1280);
  RealTransform transform(1280);
  const auto back = transform.inverse(transform.forward(series));
  for (std::size_t k = 0; k < series.size(); ++k) EXPECT_NEAR(back[k], series[k], 1e-12);
}

TEST(RealTransform, FindsACosineInItsBin) {
  constexpr std::size_t kLength = 48;
  std::vector<double> series(kLength);
  for (std::size_t k = 0; k < kLength; ++k) {
    series[k] = std::cos(2.0 * std::numbers::pi * 5.0 * static_cast<double>(k) / kLength);
  }
  RealTransform transform(kLength);
  const auto spectrum = transform.forward(series);
  ASSERT_EQ(spectrum.size(), kLength / 2 + 1);
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    EXPECT_NEAR(std::abs(spectrum[i]), i == 5 ? kLength / 2.0 : 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace loopscope::core::loop
