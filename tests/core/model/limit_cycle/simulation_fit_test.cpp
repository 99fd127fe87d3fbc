#include "core/model/limit_cycle/simulation_fit.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/simulate/random.hpp"

namespace loopscope::core::model {
namespace {

struct Case {
  std::vector<double> input, pv, weights;
};

/// First order, lag 3, delay 3, gain -2, with a steep drift and white noise.
Case known_process(double noise, std::uint64_t seed) {
  simulate::GaussianSource normal(seed);
  Case result;
  double state = 0.0;
  const double pole = std::exp(-1.0 / 3.0);
  for (std::size_t k = 0; k < 1200; ++k) {
    result.input.push_back((k / 13) % 2 == 0 ? 1.0 : -1.0);
    state = pole * state + (1.0 - pole) * (k >= 3 ? result.input[k - 3] : 0.0);
    result.pv.push_back(-2.0 * state + 0.01 * static_cast<double>(k) + noise * normal.next());
    result.weights.push_back(1.0);
  }
  return result;
}

TEST(SimulationFit, FindsAKnownProcessUnderDrift) {
  const Case c = known_process(0.0, 1);
  const CycleBand band(26.0);
  const std::vector<double> pv = band.pass(c.pv);
  SimulationFit fit(band, pv, c.weights, 0.0, 7);
  EXPECT_EQ(fit.held_out(), 1.0);
  fit.offer(c.input);
  EXPECT_EQ(fit.best().lag, 3.0);
  EXPECT_EQ(fit.best().delay, 3U);
  EXPECT_NEAR(fit.best().gain, -2.0, 0.1);
  EXPECT_LT(fit.held_out(), 0.05);
}

TEST(SimulationFit, AWrongSignOfTheControllerExplainsLess) {
  const Case c = known_process(0.0, 1);
  const CycleBand band(26.0);
  const std::vector<double> pv = band.pass(c.pv);
  SimulationFit fit(band, pv, c.weights, 1.0, 2);
  fit.offer(c.input);
  EXPECT_GT(fit.held_out(), 0.5);
}

TEST(SimulationFit, MissingSamplesDoNotCount) {
  Case c = known_process(0.1, 2);
  for (std::size_t k = 300; k < 340; ++k) {
    c.pv[k] = 1e3;
    c.weights[k] = 0.0;
  }
  const CycleBand band(26.0);
  std::vector<double> pv = band.pass(known_process(0.1, 2).pv);
  for (std::size_t k = 300; k < 340; ++k) pv[k] = 1e3;
  SimulationFit fit(band, pv, c.weights, 0.0, 7);
  fit.offer(c.input);
  EXPECT_LT(fit.held_out(), 0.05);
}

TEST(SimulationFit, AnInputThatHasNothingToDoWithPvGainsNothingOutOfSample) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    simulate::GaussianSource normal(seed);
    std::vector<double> input(1200), noise(1200);
    for (std::size_t k = 0; k < input.size(); ++k) {
      input[k] = normal.next();
      noise[k] = normal.next();
    }
    const CycleBand band(26.0);
    const std::vector<double> pv = band.pass(noise);
    const std::vector<double> weights(1200, 1.0);
    SimulationFit fit(band, pv, weights, 0.0, 7);
    fit.offer(input);
    sum += fit.held_out();
  }
  EXPECT_GT(sum / 20.0, 0.99);
}

}  // namespace
}  // namespace loopscope::core::model
