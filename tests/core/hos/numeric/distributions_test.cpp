#include "core/hos/numeric/distributions.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kNaN;

TEST(NormalDistribution, UpperTail) {
  EXPECT_DOUBLE_EQ(normal_upper(0.0), 0.5);
  EXPECT_NEAR(normal_upper(1.6448536269514722), 0.05, 1e-15);
  EXPECT_NEAR(normal_upper(6.0) / 9.865876450376946e-10, 1.0, 1e-12);
}

// Solutions of erfc(z / sqrt 2) = 2 alpha in forty-digit arithmetic.
TEST(NormalDistribution, QuantilesOfTheUsualLevels) {
  EXPECT_NEAR(normal_upper_quantile(0.5), 0.0, 1e-15);
  EXPECT_NEAR(normal_upper_quantile(0.05), 1.6448536269514727, 1e-15);
  EXPECT_NEAR(normal_upper_quantile(0.025), 1.959963984540054, 1e-15);
  EXPECT_NEAR(normal_upper_quantile(0.01), 2.3263478740408411, 1e-15);
  EXPECT_NEAR(normal_upper_quantile(0.0001), 3.7190164854556806, 2e-15);
}

TEST(NormalDistribution, TheQuantileInvertsTheTail) {
  for (double alpha = 0.999; alpha > 1e-300; alpha *= 0.7) {
    // The tail's relative error is z^2 times that of z: rounding of z alone gives 1e-13 at z = 37.
    EXPECT_NEAR(normal_upper(normal_upper_quantile(alpha)) / alpha, 1.0, 1e-12) << alpha;
  }
}

TEST(ChiSquareDistribution, UpperTail) {
  EXPECT_NEAR(chi_square_upper(3.841458821, 1), 0.05, 1e-9);
  EXPECT_NEAR(chi_square_upper(7.0, 2), std::exp(-3.5), 1e-15);
  EXPECT_NEAR(chi_square_upper(7.0, 4), std::exp(-3.5) * (1.0 + 3.5), 1e-15);
  EXPECT_NEAR(chi_square_upper(37.65248413, 25), 0.05, 1e-9);
  EXPECT_EQ(chi_square_upper(0.0, 5), 1.0);
  EXPECT_NEAR(chi_square_upper(1200.0, 2) / std::exp(-600.0), 1.0, 1e-12);
  EXPECT_EQ(chi_square_upper(1e6, 2), 0.0);
}

TEST(GammaDistribution, OfAWholeShapeIsAPoissonSum) {
  EXPECT_NEAR(gamma_upper(2.0, 3.0), std::exp(-2.0) * (1.0 + 2.0 + 2.0), 1e-15);
  EXPECT_EQ(gamma_upper(-1.0, 3.0), 1.0);
}

TEST(FDistribution, MeetsTheTables) {
  // Upper quantiles (any table, e.g. Abramowitz and Stegun 26.9), to their four digits.
  struct Quantile {
    double freedom_1, freedom_2, ratio, p;
  };
  for (const Quantile& known : {Quantile{10, 10, 2.978, 0.05}, Quantile{10, 30, 2.979, 0.01},
                                Quantile{60, 120, 1.429, 0.05}, Quantile{20, 60, 2.198, 0.01},
                                Quantile{5, 40, 2.449, 0.05}}) {
    EXPECT_NEAR(f_upper(known.ratio, known.freedom_1, known.freedom_2), known.p, 2e-3 * known.p)
        << known.ratio;
  }
}

TEST(FDistribution, OfTwoFreedomsAboveIsAPower) {
  // With two degrees of freedom above: (1 + 2 x / m)^(-m / 2).
  for (const double ratio : {0.01, 1.0, 30.0, 1e4})
    EXPECT_NEAR(f_upper(ratio, 2.0, 7.0) / std::pow(1.0 + 2.0 * ratio / 7.0, -3.5), 1.0, 1e-12)
        << ratio;
  EXPECT_EQ(f_upper(0.0, 2.0, 7.0), 1.0);
  EXPECT_TRUE(std::isnan(f_upper(kNaN, 2.0, 7.0)));
}

TEST(FDistribution, TheDeviateHasTheSameTail) {
  for (const double ratio : {0.02, 0.5, 0.97, 1.03, 2.5, 40.0}) {
    const double deviate = f_deviate(ratio, 12.0, 30.0);
    EXPECT_NEAR(normal_upper(deviate) / f_upper(ratio, 12.0, 30.0), 1.0, 1e-11) << ratio;
    EXPECT_NEAR(deviate, -f_deviate(1.0 / ratio, 30.0, 12.0), 1e-9) << ratio;
  }
}

TEST(FDistribution, TheDeviateStaysWithinItsBounds) {
  EXPECT_NEAR(f_deviate(1e9, 500.0, 500.0), 37.0, 0.1);
  EXPECT_NEAR(f_deviate(0.0, 500.0, 500.0), -37.0, 0.1);
  EXPECT_NEAR(f_deviate(1e-300, 500.0, 500.0), -37.0, 0.1);
  EXPECT_TRUE(std::isnan(f_deviate(kNaN, 2.0, 7.0)));
}

TEST(StudentDistribution, MeetsTheTables) {
  EXPECT_NEAR(student_upper(2.1318467863, 4.0), 0.05, 1e-10);
  EXPECT_NEAR(student_upper(-1.0, 1.0), 0.75, 1e-14);  // Cauchy
  EXPECT_NEAR(student_upper(1e12, 4.0) / student_upper(1e13, 4.0), 1e4, 1e-8);
}

TEST(BinomialDistribution, AtLeast) {
  // Two sixes or more in three throws: 3 (1/36)(5/6) + 1/216.
  EXPECT_NEAR(binomial_at_least(2, 3, 1.0 / 6.0), 16.0 / 216.0, 1e-14);
  EXPECT_NEAR(binomial_at_least(1, 1, 0.3), 0.3, 1e-14);
  EXPECT_EQ(binomial_at_least(0, 5, 0.1), 1.0);
  // Far out: one term rules, C(30, 10) p^10.
  EXPECT_NEAR(binomial_at_least(10, 30, 1e-6) / (30045015.0 * 1e-60), 1.0, 1e-4);
}

}  // namespace
}  // namespace loopscope::core::hos
