#include "core/loop/variance_error.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/signal/order/spread.hpp"
#include "tests/core/loop/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;
using signals::Wave;

using loopscope::tests::kWindow;
constexpr int kScatterRecords = 200;

/// What the formula says beside what 200 records show.
struct Scatter {
  double said = 0.0;   ///< median
  double shown = 0.0;  ///< standard deviation of the logarithms of the variances
};

Scatter scatter_of(const std::function<Series(Random&)>& draw) {
  std::vector<double> said, logs;
  for (int seed = 1; seed <= kScatterRecords; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Series series = draw(random);
    said.push_back(log_variance_error(series).value());
    logs.push_back(2.0 * std::log(signal::measure_spread(series)->std));
  }
  std::nth_element(said.begin(), said.begin() + kScatterRecords / 2, said.end());
  return {said[kScatterRecords / 2], signal::measure_spread(logs)->std};
}

/// The shown scatter of 200 records is itself known to 5 %; the formula is taken to hold where the
/// two differ by less than a fifth.
void expect_agreement(const Scatter& scatter) {
  EXPECT_NEAR(scatter.said / scatter.shown, 1.0, 0.2) << scatter.said << " " << scatter.shown;
}

TEST(VarianceError, WhiteNoiseHasItsClosedForm) {
  // var(s^2) / s^4 = 2 / n.
  const Scatter scatter =
      scatter_of([](Random& random) { return signals::white(random, kWindow); });
  EXPECT_NEAR(scatter.said, std::sqrt(2.0 / kWindow), 0.002);
  expect_agreement(scatter);
}

TEST(VarianceError, Ar1HasItsClosedForm) {
  // Bartlett: 2 / n (1 + phi^2) / (1 - phi^2).
  const double phi = 0.9;
  const Scatter scatter =
      scatter_of([&](Random& random) { return signals::ar1(random, kWindow, phi); });
  EXPECT_NEAR(scatter.said, std::sqrt(2.0 / kWindow * (1.0 + phi * phi) / (1.0 - phi * phi)), 0.01);
  expect_agreement(scatter);
}

TEST(VarianceError, HoldsForSlowNoiseAndResonances) {
  expect_agreement(scatter_of([](Random& random) { return signals::ar1(random, kWindow, 0.98); }));
  expect_agreement(
      scatter_of([](Random& random) { return signals::resonance(random, kWindow, 40.0, 0.98); }));
}

TEST(VarianceError, SustainedWaveIsKnownBetterThanNoiseOfItsSpectrum) {
  const auto wave = [](Random& random) {
    return signals::at_snr(signals::wave(random, kWindow, Wave::triangle, 50.0),
                           signals::white(random, kWindow), 10.0);
  };
  const auto noise = [](Random& random) {
    return signals::resonance(random, kWindow, 50.0, 0.995);
  };
  EXPECT_LT(scatter_of(wave).said, 0.2 * scatter_of(noise).said);
}

TEST(VarianceError, NeitherUnitNorLevelCounts) {
  Random random(3);
  const Series series = signals::ar1(random, kWindow, 0.9);
  Series moved = series;
  for (double& value : moved) value = 1000.0 * value + 7.0;
  EXPECT_NEAR(log_variance_error(series).value(), log_variance_error(moved).value(), 1e-9);
}

TEST(VarianceError, MissingSamplesCostWhatTheyKnew) {
  Random random(4);
  const Series series = signals::white(random, kWindow);
  const Series half = signals::with_missing(random, series, 0.5);
  EXPECT_NEAR(log_variance_error(half).value() / log_variance_error(series).value(), std::sqrt(2.0),
              0.15);
}

TEST(VarianceError, NothingToMeasureIsNothing) {
  EXPECT_FALSE(log_variance_error(Series{}));
  EXPECT_FALSE(log_variance_error(Series(100, 5.0)));
  EXPECT_FALSE(log_variance_error(Series(100, std::numeric_limits<double>::quiet_NaN())));
}

TEST(VarianceError, SquareWaveScattersNotAtAll) {
  Series square(kWindow);
  for (std::size_t k = 0; k < kWindow; ++k) square[k] = (k / 8) % 2 == 0 ? 1.0 : -1.0;
  EXPECT_NEAR(log_variance_error(square).value(), 0.0, 1e-9);
}

}  // namespace
}  // namespace loopscope::core::loop
