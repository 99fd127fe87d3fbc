#include "core/loop/correlation.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/loop/record_spectrum.hpp"
#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Series;

double mean_of(const Series& x) {
  double sum = 0.0, count = 0.0;
  for (const double v : x) {
    if (std::isfinite(v)) sum += v, count += 1.0;
  }
  return sum / count;
}

/// The definition, term by term.
double directly(const Series& x, const Series& y, std::ptrdiff_t lag) {
  const double mx = mean_of(x), my = mean_of(y);
  double sum = 0.0, pairs = 0.0, sx = 0.0, sy = 0.0, nx = 0.0, ny = 0.0;
  for (std::ptrdiff_t k = 0; k < std::ssize(x); ++k) {
    const double a = x[static_cast<std::size_t>(k)] - mx;
    const double own = y[static_cast<std::size_t>(k)] - my;
    if (std::isfinite(a)) sx += a * a, nx += 1.0;
    if (std::isfinite(own)) sy += own * own, ny += 1.0;
    if (k + lag < 0 || k + lag >= std::ssize(y)) continue;
    const double b = y[static_cast<std::size_t>(k + lag)] - my;
    if (std::isfinite(a) && std::isfinite(b)) sum += a * b, pairs += 1.0;
  }
  return sum / pairs / std::sqrt(sx / nx * (sy / ny));
}

TEST(Correlation, EqualsItsDefinitionWithAndWithoutGaps) {
  for (const double missing : {0.0, 0.2}) {
    signals::Random random(7);
    const Series x = signals::with_missing(random, signals::ar1(random, 200, 0.9), missing);
    const Series y = signals::with_missing(random, signals::ar1(random, 200, 0.5), missing);
    RealTransform transform(transform_length(200));
    const Correlation result = correlate(x, y, 60, transform);
    ASSERT_EQ(result.max_lag, 60U);
    for (std::ptrdiff_t lag = -60; lag <= 60; ++lag) {
      EXPECT_NEAR(result.at(lag), directly(x, y, lag), 1e-10);
    }
  }
}

TEST(Correlation, WithItselfIsTheAutocorrelation) {
  signals::Random random(8);
  const Series x = signals::ar1(random, 300, 0.8);
  RealTransform transform(transform_length(300));
  const auto acf = autocorrelate(x, 100, transform);
  const Correlation both = correlate(x, x, 100, transform);
  ASSERT_EQ(acf.size(), 101U);
  EXPECT_NEAR(acf[0], 1.0, 1e-12);
  for (std::ptrdiff_t lag = 0; lag <= 100; ++lag) {
    EXPECT_NEAR(acf[static_cast<std::size_t>(lag)], both.at(lag), 1e-12);
    EXPECT_NEAR(both.at(lag), both.at(-lag), 1e-12);
  }
}

TEST(Correlation, DelayedCopyPeaksAtTheDelay) {
  signals::Random random(9);
  const Series source = signals::white(random, 510);
  const Series x(source.begin() + 10, source.end());
  const Series y(source.begin(), source.end() - 10);
  RealTransform transform(transform_length(500));
  const Correlation result = correlate(x, y, 50, transform);
  for (std::ptrdiff_t lag = -50; lag <= 50; ++lag) {
    // 490 pairs: standard deviation 0.045.
    EXPECT_NEAR(result.at(lag), lag == 10 ? 1.0 : 0.0, 0.2);
  }
}

TEST(Correlation, StopsWhereTooFewPairsAreLeft) {
  signals::Random random(10);
  Series x = signals::white(random, 400);
  std::fill(x.begin() + 100, x.end(), std::nan(""));
  RealTransform transform(transform_length(400));
  // 100 samples, 100 - lag pairs, an eighth of the samples is 12.5.
  EXPECT_EQ(autocorrelate(x, 200, transform).size(), 88U);
}

TEST(Correlation, OfAConstantOrOfNothingIsEmpty) {
  RealTransform transform(transform_length(64));
  const Series constant(64, 3.3), nothing(64, std::nan(""));
  EXPECT_TRUE(autocorrelate(constant, 10, transform).empty());
  EXPECT_TRUE(autocorrelate(nothing, 10, transform).empty());
  EXPECT_TRUE(correlate(constant, nothing, 10, transform).values.empty());
}

}  // namespace
}  // namespace loopscope::core::loop
