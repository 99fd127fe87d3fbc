#include "core/hos/linear/draw_missing.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "tests/core/hos/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kInfinity;
using loopscope::tests::kNaN;

/// Every third sample a hole, bounded by `band` about the truth; the guess is the line within.
Holes every_third(std::vector<double>& record, double band) {
  Holes holes{std::vector<double>(record.size(), kNaN), std::vector<double>(record.size(), kNaN)};
  for (std::size_t k = 1; k < record.size(); k += 3) {
    holes.low[k] = record[k] - band;
    holes.high[k] = record[k] + band;
    const double line = k + 1 < record.size() ? 0.5 * (record[k - 1] + record[k + 1]) : record[k];
    record[k] = std::clamp(line, holes.low[k], holes.high[k]);
  }
  return holes;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// A sample between two known ones of this process has the standard deviation
/// 1 / sqrt(1 + a1^2 + a2^2) = 0.44; a draw differs from the truth by sqrt(2) of that in a third of
/// the samples.
TEST(DrawMissing, DrawsDifferFromTheTruthAsMuchAsItIsUncertain) {
  const std::vector<double> truth = tests::resonance(1);
  std::vector<double> record = truth;
  const Holes holes = every_third(record, kInfinity);
  const double a1 = 2.0 * 0.95 * std::cos(2.0 * M_PI / 20.0);
  const double expected = std::sqrt(2.0 / 3.0 / (1.0 + a1 * a1 + 0.9025 * 0.9025));
  EXPECT_NEAR(rms(draw_missing(record, holes, 1), truth), expected, 0.1 * expected);
}

TEST(DrawMissing, KeepsWhatWasStoredAndTheBounds) {
  const std::vector<double> truth = tests::resonance(2);
  std::vector<double> record = truth;
  const Holes holes = every_third(record, 0.2);
  const std::vector<double> drawn = draw_missing(record, holes, 1);
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    if (std::isnan(holes.low[k])) {
      EXPECT_DOUBLE_EQ(drawn[k], truth[k]);
    } else {
      EXPECT_GE(drawn[k], holes.low[k] - 1e-9);
      EXPECT_LE(drawn[k], holes.high[k] + 1e-9);
    }
  }
}

TEST(DrawMissing, TheSeedDecides) {
  std::vector<double> record = tests::resonance(3);
  const Holes holes = every_third(record, kInfinity);
  EXPECT_EQ(draw_missing(record, holes, 7), draw_missing(record, holes, 7));
  EXPECT_NE(draw_missing(record, holes, 7), draw_missing(record, holes, 8));
}

TEST(DrawMissing, GapsStayGaps) {
  std::vector<double> record = tests::resonance(4);
  const Holes holes = every_third(record, kInfinity);
  for (std::size_t k = 1000; k < 1100; ++k) record[k] = kNaN;
  const std::vector<double> drawn = draw_missing(record, holes, 1);
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    EXPECT_EQ(std::isnan(drawn[k]), k >= 1000 && k < 1100);
  }
}

TEST(DrawMissing, AnyScaleAndHolesAtTheEndsAreDrawn) {
  for (const double scale : {1e-300, 1.0, 1e300}) {
    std::vector<double> record = tests::resonance(5);
    Holes holes = every_third(record, kInfinity);
    for (const std::size_t k : {std::size_t{0}, record.size() - 1}) {
      holes.low[k] = -kInfinity;
      holes.high[k] = kInfinity;
    }
    for (double& value : record) value *= scale;
    for (const double value : draw_missing(record, holes, 1)) {
      EXPECT_LT(std::abs(value), 30.0 * scale);
    }
  }
}

TEST(DrawMissing, WithoutHolesOrVarianceNothingHappens) {
  const std::vector<double> record = tests::resonance(6);
  EXPECT_EQ(draw_missing(record, {}, 1), record);
  std::vector<double> constant(500, 2.0);
  const Holes holes = every_third(constant, kInfinity);
  const std::vector<double> guesses = std::vector<double>(500, 2.0);
  EXPECT_EQ(draw_missing(guesses, holes, 1), guesses);
}

}  // namespace
}  // namespace loopscope::core::hos
