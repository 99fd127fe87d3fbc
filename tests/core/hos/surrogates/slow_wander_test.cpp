#include "core/hos/surrogates/slow_wander.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

double mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  double count = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value * value;
    count += 1.0;
  }
  return sum / count;
}

std::vector<double> cosine(double period) {
  std::vector<double> wave(4096);
  for (std::size_t t = 0; t < wave.size(); ++t) {
    wave[t] = 40.0 + std::cos(2.0 * std::numbers::pi * static_cast<double>(t) / period);
  }
  return wave;
}

TEST(HosSlowWander, TakesWhatIsSlowAndLeavesWhatIsFast) {
  EXPECT_LT(mean_square(without_slow_wander(cosine(4096.0))), 1e-5);
  EXPECT_LT(mean_square(without_slow_wander(cosine(700.0))), 0.05);
  EXPECT_NEAR(mean_square(without_slow_wander(cosine(100.0))), 0.5, 0.02);
  EXPECT_NEAR(mean_square(without_slow_wander(tests::white_noise(1))), 1.0, 0.1);
}

TEST(HosSlowWander, GapsStay) {
  auto wave = cosine(100.0);
  for (std::size_t t = 1000; t < 2000; ++t) wave[t] = std::nan("");
  const auto left = without_slow_wander(wave);
  EXPECT_TRUE(std::isnan(left[1500]));
  EXPECT_NEAR(mean_square(left), 0.5, 0.05);
}

TEST(HosSlowWander, OfNothingNothing) {
  EXPECT_TRUE(without_slow_wander({}).empty());
  EXPECT_TRUE(std::isnan(without_slow_wander(std::vector<double>(3, std::nan("")))[1]));
}

}  // namespace
}  // namespace loopscope::core::hos
