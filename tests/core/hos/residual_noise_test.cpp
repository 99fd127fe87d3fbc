#include "core/hos/residual_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "core/simulate/innovations.hpp"
#include "tests/core/hos/rejections.hpp"

namespace loopscope::core::hos {
namespace {

using Core = ResidualNoise::Core;
using simulate::Innovation;

struct Verdicts {
  double gaussian = 0.0;
  double undecided = 0.0;
  double other = 0.0;
};

Verdicts verdicts(const char* name, const tests::Draw& draw) {
  const int records = tests::records(400);
  Verdicts shares;
  for (int seed = 1; seed <= records; ++seed) {
    const Core core = ResidualNoise(draw(static_cast<std::uint64_t>(seed))).core();
    (core == Core::gaussian    ? shares.gaussian
     : core == Core::undecided ? shares.undecided
                               : shares.other) += 1.0 / records;
  }
  std::printf("| %-12s | %5.1f %% | %5.1f %% | %5.1f %% |\n", name, 100.0 * shares.gaussian,
              100.0 * shares.undecided, 100.0 * shares.other);
  return shares;
}

tests::Draw law(Innovation innovation) {
  return [=](std::uint64_t seed) { return simulate::innovations(innovation, 4096, seed); };
}

std::vector<double> logistic(std::uint64_t seed) {
  auto values = simulate::innovations(Innovation::uniform, 4096, seed);
  for (double& value : values) {
    const double share = 0.5 + value / std::sqrt(12.0);
    value = std::log(share / (1.0 - share));
  }
  return values;
}

TEST(HosResidualNoise, TellsTheCoreOfTheUsualLaws) {
  EXPECT_GE(verdicts("normal", law(Innovation::gaussian)).gaussian, 0.98);
  EXPECT_GE(verdicts("logistic", logistic).undecided, 0.85);
  EXPECT_GE(verdicts("Laplace", law(Innovation::laplace)).other, 0.9);
  EXPECT_GE(verdicts("exponential", law(Innovation::exponential)).other, 0.999);
  EXPECT_GE(verdicts("uniform", law(Innovation::uniform)).other, 0.999);
}

TEST(HosResidualNoise, EventsDoNotHideANormalCore) {
  const auto with_events = [](std::uint64_t seed) {
    auto values = simulate::innovations(Innovation::gaussian, 4096, seed);
    for (std::size_t i = 0; i < 40; ++i) values[100 * i] += i % 2 == 0 ? 30.0 : -30.0;
    return values;
  };
  EXPECT_GE(verdicts("events", with_events).gaussian, 0.95);
  // Nor do they reach the draws.
  const ResidualNoise noise(with_events(1));
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) ASSERT_LT(std::abs(noise.draw(random)), 12.0);
}

std::vector<double> draws(const ResidualNoise& noise, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(noise.draw(random));
  return values;
}

TEST(HosResidualNoise, KeepsTheTailsOfExponentialNoise) {
  // Upper quantiles of exponential noise about its mean are -ln(share) - 1; of many residuals, so
  // that only the continued tail can be wrong.
  const ResidualNoise noise(simulate::innovations(Innovation::exponential, 100'000, 3));
  auto drawn = draws(noise, 400'000, 4);
  std::sort(drawn.begin(), drawn.end(), std::greater<>());
  for (const double share : {0.5, 0.1, 0.01, 0.001}) {
    const double expected = -std::log(share) - 1.0;
    const auto at = static_cast<std::size_t>(share * static_cast<double>(drawn.size()));
    EXPECT_NEAR(drawn[at], expected, 0.05 * (expected + 1.0)) << share;
  }
}

TEST(HosResidualNoise, HasMeanZeroWhateverTheResiduals) {
  for (const Innovation innovation : {Innovation::gaussian, Innovation::exponential}) {
    auto residuals = simulate::innovations(innovation, 4096, 5);
    for (double& value : residuals) value += 100.0;
    const auto drawn = draws(ResidualNoise(residuals), 200'000, 6);
    double mean = 0.0;
    for (const double value : drawn) mean += value / 200'000.0;
    EXPECT_NEAR(mean, 0.0, 0.012);
  }
}

TEST(HosResidualNoise, MirroredResidualsGiveMirroredNoise) {
  auto residuals = simulate::innovations(Innovation::exponential, 4096, 7);
  const auto drawn = draws(ResidualNoise(residuals), 50'000, 8);
  std::transform(residuals.begin(), residuals.end(), residuals.begin(), std::negate<>());
  const auto mirrored = draws(ResidualNoise(residuals), 50'000, 8);
  EXPECT_NEAR(*std::max_element(drawn.begin(), drawn.end()),
              -*std::min_element(mirrored.begin(), mirrored.end()), 0.01);
}

TEST(HosResidualNoise, TheSameSeedDrawsTheSame) {
  const ResidualNoise noise(simulate::innovations(Innovation::laplace, 4096, 9));
  EXPECT_EQ(draws(noise, 1000, 1), draws(noise, 1000, 1));
  EXPECT_NE(draws(noise, 1000, 1), draws(noise, 1000, 2));
}

TEST(HosResidualNoise, WithoutSpreadItIsOtherAndDrawsNothing) {
  const ResidualNoise noise(std::vector<double>(100, 3.0));
  EXPECT_EQ(noise.core(), Core::other);
  for (const double value : draws(noise, 100, 1)) EXPECT_EQ(value, 0.0);
}

}  // namespace
}  // namespace loopscope::core::hos
