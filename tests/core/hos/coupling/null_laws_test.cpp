#include "core/hos/coupling/null_laws.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::hos {
namespace {

TEST(HosNullLaws, MeanLawHasItsMoments) {
  constexpr double kMean = 1.01;
  for (const double std : {0.05, 0.1, 0.3}) {
    // E of (X - m)^n from its tail by parts: n times the integral of (x - m)^(n-1) P(X > x), from a
    // point below which there is nothing.
    const double low = kMean - 20.0 * std;
    const double step = std / 200.0;
    double mean = low;
    double variance = (low - kMean) * (low - kMean);
    double third = std::pow(low - kMean, 3.0);
    for (double x = low + 0.5 * step; x < kMean + 40.0 * std; x += step) {
      const double tail = mean_law_upper(x, kMean, std) * step;
      mean += tail;
      variance += 2.0 * (x - kMean) * tail;
      third += 3.0 * (x - kMean) * (x - kMean) * tail;
    }
    EXPECT_NEAR(mean, kMean, 1e-4);
    EXPECT_NEAR(std::sqrt(variance) / std, 1.0, 1e-3);
    EXPECT_NEAR(third / std::pow(std, 3.0) / (2.9 * std / kMean), 1.0, 1e-2);
  }
}

TEST(HosNullLaws, MeanLawOfSkewnessTwoIsExponential) {
  // Skewness 2.9 std / mean = 2 makes the gamma distribution an exponential one.
  constexpr double kStd = 2.0 / 2.9;
  for (const double x : {0.4, 1.0, 3.0, 20.0}) {
    EXPECT_NEAR(mean_law_upper(x, 1.0, kStd) / std::exp(-(x - 1.0 + kStd) / kStd), 1.0, 1e-12);
  }
}

TEST(HosNullLaws, MeanLawFallsAndStaysAboveZero) {
  double before = 2.0;
  for (double x = 0.0; x < 127.0; x += 0.01) {
    const double p = mean_law_upper(x, 1.0, 0.1);
    ASSERT_LE(p, before);
    ASSERT_LE(p, 1.0);
    ASSERT_GT(p, 0.0) << x;
    before = p;
  }
  EXPECT_EQ(mean_law_upper(0.0, 1.0, 0.1), 1.0);
}

TEST(HosNullLaws, MeanLawWithoutSpreadSaysNothing) {
  EXPECT_EQ(mean_law_upper(5.0, 1.0, 0.0), 1.0);
}

/// Mixture of Erlang laws with a Poisson number of stages.
double cell_series(double evidence, double level) {
  double poisson = std::exp(-level);
  double term = std::exp(-evidence);
  double erlang = term;
  double sum = 0.0;
  for (int j = 0; j < 400; ++j) {
    sum += poisson * erlang;
    poisson *= level / (j + 1);
    term *= evidence / (j + 1);
    erlang += term;
  }
  return sum;
}

TEST(HosNullLaws, CellLawIsExponentialWithoutCoupling) {
  for (const double evidence : {0.0, 1.0, 20.0, 600.0}) {
    EXPECT_DOUBLE_EQ(cell_law_upper(evidence, 0.0), std::exp(-evidence));
  }
}

TEST(HosNullLaws, CellLawIsTheNoncentralChiSquare) {
  for (const double level : {0.01, 0.5, 5.0, 40.0}) {
    for (const double evidence : {0.1, 1.0, 10.0, 60.0, 250.0}) {
      EXPECT_NEAR(cell_law_upper(evidence, level) / cell_series(evidence, level), 1.0, 1e-8)
          << evidence << ' ' << level;
    }
  }
}

TEST(HosNullLaws, CellLawFallsWithEvidenceAndRisesWithLevel) {
  for (const double level : {0.01, 1.0, 20.0, 60.0}) {
    double before = 2.0;
    for (double evidence = 0.0; evidence < 299.0; evidence += 1.0) {
      const double p = cell_law_upper(evidence, level);
      EXPECT_LE(p, before) << evidence << ' ' << level;
      EXPECT_GE(p * (1.0 + 1e-9), cell_law_upper(evidence, 0.9 * level));
      before = p;
    }
  }
}

TEST(HosNullLaws, CellLawHoldsOnBeyondItsSeries) {
  // The bound is above the law by a power of the evidence; on the scale of the logarithm, the only
  // one that matters at 1e-100, by a few per cent.
  for (const double level : {0.01, 1.0, 20.0, 60.0}) {
    const double inside = std::log(cell_law_upper(299.99, level));
    const double beyond = std::log(cell_law_upper(300.01, level));
    EXPECT_GE(beyond, inside - 0.1);
    EXPECT_NEAR(beyond / inside, 1.0, 0.05) << level;
  }
}

TEST(HosNullLaws, NoPValueIsZero) {
  for (const double level : {0.0, 0.01, 50.0}) {
    for (const double evidence : {300.0, 750.0, 3000.0, 1e5}) {
      EXPECT_GT(cell_law_upper(evidence, level), 0.0) << evidence << ' ' << level;
      EXPECT_GT(smallest_of(cell_law_upper(evidence, level), 442.0), 0.0);
    }
  }
}

TEST(HosNullLaws, SmallestOfManyIsTheComplementOfNone) {
  EXPECT_NEAR(smallest_of(0.05, 10.0), 1.0 - std::pow(0.95, 10.0), 1e-14);
  EXPECT_NEAR(smallest_of(1e-200, 440.0) / 440e-200, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(smallest_of(0.3, 1.0), 0.3);
  EXPECT_NEAR(smallest_of(1.0, 1.0), 1.0, 1e-11);
  EXPECT_LE(smallest_of(1.0, 1000.0), 1.0);
}

}  // namespace
}  // namespace loopscope::core::hos
