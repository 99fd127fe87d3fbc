#include "core/loop/ellipse.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/loop/record_spectrum.hpp"
#include "tests/core/loop/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Series;

using loopscope::tests::kTurn;

Series cosine(std::size_t count, double amplitude, double period, double phase) {
  Series series(count);
  for (std::size_t k = 0; k < count; ++k) {
    series[k] = amplitude * std::cos(kTurn * static_cast<double>(k) / period + phase);
  }
  return series;
}

/// Only lag 0 is offered, so that the ellipse is not folded into a line.
std::optional<EllipseFigures> without_lag(const Series& op, const Series& pv) {
  RealTransform transform(transform_length(op.size()));
  return measure_ellipse(op, pv, correlate(op, pv, 0, transform), 100.0);
}

TEST(Ellipse, WidthAtTheMeanOfPvIsExact) {
  // op = A cos t, pv = B cos(t + 60 degrees): where pv is 0, op = +-A sin 60 degrees.
  const auto figures =
      without_lag(cosine(1000, 3.0, 100.0, 0.0), cosine(1000, 7.0, 100.0, kTurn / 6));
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->stiction, 100.0 * std::sin(kTurn / 6), 0.01);
  EXPECT_NEAR(figures->r2, 1.0, 1e-6);
}

TEST(Ellipse, LagCompensationLeavesALine) {
  const Series op = cosine(1000, 3.0, 100.0, 0.0), pv = cosine(1000, 7.0, 100.0, kTurn / 6);
  RealTransform transform(transform_length(op.size()));
  const auto figures = measure_ellipse(op, pv, correlate(op, pv, 100, transform), 100.0);
  ASSERT_TRUE(figures);
  EXPECT_LT(figures->stiction, 5.0);  // the lag is a whole number of samples
}

TEST(Ellipse, ExactLineHasNoWidth) {
  const Series op = cosine(1000, 3.0, 100.0, 0.0);
  const auto figures = without_lag(op, op);
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->stiction, 0.0);
  EXPECT_EQ(figures->r2, 1.0);
}

TEST(Ellipse, DoesNotDependOnUnits) {
  signals::Random random(1);
  const Series op = signals::sum(cosine(2000, 1.0, 100.0, 0.0), signals::white(random, 2000), 0.1);
  const Series pv = signals::sum(cosine(2000, 1.0, 100.0, 1.0), signals::white(random, 2000), 0.1);
  Series tiny = pv, huge = op;
  for (double& v : tiny) v *= 1e-12;
  for (double& v : huge) v *= 1e12;
  const auto one = without_lag(op, pv);
  const auto other = without_lag(huge, tiny);
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(one->stiction, other->stiction, 1e-6);
  EXPECT_NEAR(one->r2, other->r2, 1e-6);
}

TEST(Ellipse, CloudOfNoiseIsInconclusive) {
  signals::Random random(2);
  const Series op = signals::white(random, 4000);
  const Series pv = signals::sum(op, signals::white(random, 4000), 1.0);
  const auto figures = without_lag(op, pv);
  ASSERT_TRUE(figures);
  EXPECT_LT(figures->r2, 0.2);
}

TEST(Ellipse, UncorrelatedSignalsHaveNone) {
  signals::Random random(3);
  EXPECT_FALSE(without_lag(signals::white(random, 4000), signals::white(random, 4000)));
}

}  // namespace
}  // namespace loopscope::core::loop
