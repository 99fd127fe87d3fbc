#include "core/signal/neighbour_errors.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/signal/order/spread.hpp"
#include "core/simulate/coloured_noise.hpp"

namespace loopscope::core::signal {
namespace {

Samples coloured(const simulate::AllPole& filter) {
  return simulate::coloured_noise(filter, simulate::Innovation::gaussian, 4096, 1);
}

double std_of_errors(const Samples& samples) {
  return measure_spread(neighbour_errors(samples, {}))->std;
}

TEST(NeighbourErrors, AreTheSamplesThemselvesInWhiteNoise) {
  EXPECT_NEAR(std_of_errors(coloured(simulate::real_pole(0.0))), 1.0, 0.05);
}

TEST(NeighbourErrors, AreThoseOfTheBestGuessFromBothSides) {
  // The variance of the innovations over 1 + a1^2 + a2^2.
  const simulate::AllPole filter = simulate::resonance(20.0, 0.9);
  const double best = 1.0 / std::sqrt(1.0 + filter.a1 * filter.a1 + filter.a2 * filter.a2);
  EXPECT_NEAR(std_of_errors(coloured(filter)), best, 0.03);
}

TEST(NeighbourErrors, SuspectsDoNotEnterTheFit) {
  Samples samples = coloured(simulate::real_pole(0.9));
  const double calm = neighbour_errors(samples, {})[1010];
  std::vector<bool> suspect(samples.size(), false);
  samples[1000] += 1000.0;
  suspect[1000] = true;
  EXPECT_NEAR(neighbour_errors(samples, suspect)[1010], calm, 0.05);
  EXPECT_GT(std::abs(neighbour_errors(samples, suspect)[1000]), 900.0);
}

TEST(NeighbourErrors, NothingIsKnownBesideGapsAndOfConstants) {
  Samples samples = coloured(simulate::real_pole(0.5));
  samples[500] = kMissing;
  const std::vector<double> errors = neighbour_errors(samples, {});
  for (const std::size_t k : {0U, 1U, 498U, 499U, 500U, 501U, 502U, 4094U, 4095U}) {
    EXPECT_EQ(errors[k], 0.0) << k;
  }
  EXPECT_NE(errors[503], 0.0);
  const std::vector<double> none = neighbour_errors(Samples(100, 5.0), {});
  EXPECT_TRUE(std::ranges::all_of(none, [](double error) { return error == 0.0; }));
  EXPECT_TRUE(neighbour_errors({}, {}).empty());
  EXPECT_EQ(neighbour_errors({1.0, 2.0, 3.0}, {}).size(), 3U);
}

TEST(NeighbourErrors, AWaveWithoutNoiseHasNone) {
  Samples samples(1000);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k] = std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / 25.0);
  }
  for (const double error : neighbour_errors(samples, {})) EXPECT_LT(std::abs(error), 1e-6);
}

}  // namespace
}  // namespace loopscope::core::signal
