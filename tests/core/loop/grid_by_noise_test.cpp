#include "core/loop/grid_by_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace loopscope::core::loop {
namespace {

/// A first-order autoregression driven by noise of deviation 1, rounded to the grid (0 = not).
std::vector<double> wandering(double pole, double grid, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> signal(4096);
  double state = normal(random) / std::sqrt(1.0 - pole * pole);
  for (double& value : signal) {
    state = pole * state + normal(random);
    value = grid > 0.0 ? grid * std::round(state / grid) : state;
  }
  return signal;
}

TEST(GridByNoise, IsTheGridOverTheNoiseAndTheRoundingWhateverTheSignalsSize) {
  for (const double pole : {0.0, 0.9, 0.99}) {
    // An autoregression does not see through the rounding: 1 + 1 / 12 to 1 + 1 / 6.
    const double found = grid_by_noise(wandering(pole, 1.0, 1)).value();
    EXPECT_GT(found, 1.0 / std::sqrt(1.0 + 1.0 / 6.0) - 0.03) << pole;
    EXPECT_LT(found, 1.0 / std::sqrt(1.0 + 1.0 / 12.0) + 0.03) << pole;
    EXPECT_NEAR(grid_by_noise(wandering(pole, 0.125, 2)).value(), 0.125, 0.004) << pole;
  }
}

TEST(GridByNoise, IsNextToNothingWithoutAGrid) {
  EXPECT_LT(grid_by_noise(wandering(0.9, 0.0, 3)).value(), 1e-2);
}

TEST(GridByNoise, LeavesGapsOut) {
  std::vector<double> signal = wandering(0.9, 0.5, 4);
  const double whole = grid_by_noise(signal).value();
  for (std::size_t k = 0; k < signal.size(); k += 100)
    signal[k] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(grid_by_noise(signal).value(), whole, 0.02);
}

TEST(GridByNoise, IsNotSaidWhereNothingVariesOrLittleIsRecorded) {
  EXPECT_FALSE(grid_by_noise(std::vector<double>(4096, 3.0)));
  EXPECT_FALSE(grid_by_noise(std::vector<double>{}));
  std::vector<double> torn = wandering(0.9, 0.5, 5);
  for (std::size_t k = 0; k < torn.size(); k += 20)
    torn[k] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(grid_by_noise(torn));
}

}  // namespace
}  // namespace loopscope::core::loop
