#include "core/loop/ar_model.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;
using testing::DoubleEq;
using testing::ElementsAre;

TEST(ArModel, FindsTheCoefficientsOfAResonance) {
  Random random(1);
  const auto model = fit_ar(signals::resonance(random, 20000, 20.0, 0.9), 2);
  ASSERT_TRUE(model);
  // Standard error of a coefficient about sqrt((1 - a2^2) / N) = 0.004.
  EXPECT_NEAR(model->coefficients[0], 1.8 * std::cos(2.0 * std::numbers::pi / 20.0), 0.016);
  EXPECT_NEAR(model->coefficients[1], -0.81, 0.016);
}

TEST(ArModel, InnovationShareOfAr1IsOneMinusPhiSquared) {
  Random random(2);
  const auto model = fit_ar(signals::ar1(random, 50000, 0.8), 5);
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->innovation_share, 0.36, 0.015);
}

TEST(ArModel, GapsCostRowsNotCorrectness) {
  Random random(3);
  const Series series = signals::with_missing(random, signals::ar1(random, 50000, 0.8), 0.05);
  const auto model = fit_ar(series, 3);
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->coefficients[0], 0.8, 0.02);
  EXPECT_NEAR(model->coefficients[1], 0.0, 0.02);
  EXPECT_NEAR(model->innovation_share, 0.36, 0.02);
}

TEST(ArModel, RunsAddUpToTheWholeRegression) {
  // One missing sample in the middle: the fit has to equal that of a record without the rows that
  // touch it. A constant series of differences would hide an error in the end terms, noise does
  // not.
  Random random(4);
  Series series = signals::ar1(random, 400, 0.6);
  series[200] = std::nan("");
  const auto model = fit_ar(series, 1);
  ASSERT_TRUE(model);
  double mean = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) mean += k == 200 ? 0.0 : series[k] / 399.0;
  double xy = 0.0, xx = 0.0;
  for (std::size_t k = 1; k < series.size(); ++k) {
    if (k == 200 || k == 201) continue;
    xy += (series[k] - mean) * (series[k - 1] - mean);
    xx += (series[k - 1] - mean) * (series[k - 1] - mean);
  }
  EXPECT_NEAR(model->coefficients[0], xy / xx, 1e-8);
}

TEST(ArModel, TooFewRowsOrNoVarianceGiveNone) {
  EXPECT_FALSE(fit_ar(Series{}, 2));
  EXPECT_FALSE(fit_ar(Series(1000, 5.0), 2));
  Random random(5);
  EXPECT_FALSE(fit_ar(signals::white(random, 100), 20));
  Series alternating = signals::white(random, 4000);
  for (std::size_t k = 0; k < alternating.size(); k += 2) alternating[k] = std::nan("");
  EXPECT_FALSE(fit_ar(alternating, 2));
}

TEST(ArModel, ImpulseResponseFollowsTheRecursion) {
  EXPECT_THAT(impulse_response({{0.5}, 1.0}, 4),
              ElementsAre(DoubleEq(1.0), DoubleEq(0.5), DoubleEq(0.25), DoubleEq(0.125)));
  EXPECT_THAT(impulse_response({{1.0, -0.5}, 1.0}, 4),
              ElementsAre(DoubleEq(1.0), DoubleEq(1.0), DoubleEq(0.5), DoubleEq(0.0)));
  EXPECT_TRUE(impulse_response({{0.5}, 1.0}, 0).empty());
}

}  // namespace
}  // namespace loopscope::core::loop
