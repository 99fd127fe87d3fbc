#include "tests/plants/network/thornhill.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/effects/random.hpp"

namespace loopscope::tests::network {
namespace {

std::vector<double> noisy(double (*shape)(double), std::uint64_t seed) {
  effects::Random random(seed);
  std::vector<double> series;
  for (int k = 0; k < 1000; ++k)
    series.push_back(shape(std::fmod(k / 20.0, 1.0)) + 0.2 * random.normal());
  return series;
}

TEST(Thornhill, SeesAWaveWithHarmonicsInPhase) {
  const auto sawtooth = noisy([](double turn) { return 2.0 * turn - 1.0; }, 1);
  EXPECT_GT(thornhill_index(sawtooth, 20.0), 1.0);
}

TEST(Thornhill, ColouredNoiseIsLinear) {
  int nonlinear = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    effects::Random random(seed);
    std::vector<double> series;
    double first = 0.0, second = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const double now = 1.8 * first - 0.9 * second + random.normal();
      second = first;
      first = now;
      series.push_back(now);
    }
    nonlinear += thornhill_index(series, 20.0) > 1.0 ? 1 : 0;
  }
  EXPECT_LE(nonlinear, 2);
}

TEST(Thornhill, ShortRecordsSayNothing) {
  EXPECT_EQ(thornhill_index(std::vector<double>(100, 1.0), 20.0), 0.0);
}

}  // namespace
}  // namespace loopscope::tests::network
