#include "core/loop/variance_ratio.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::loop {
namespace {

// Upper quantiles of the F distribution (any table, e.g. Abramowitz and Stegun 26.9).
TEST(VarianceRatio, MeetsTheTablesOfTheFDistribution) {
  struct Quantile {
    double freedom_1, freedom_2, ratio, p;
  };
  for (const Quantile& known : {Quantile{10, 10, 2.978, 0.05}, Quantile{10, 30, 2.979, 0.01},
                                Quantile{60, 120, 1.429, 0.05}, Quantile{20, 60, 2.198, 0.01},
                                Quantile{5, 40, 2.449, 0.05}}) {
    const double deviate = variance_ratio_deviate(known.ratio, known.freedom_1, known.freedom_2);
    EXPECT_NEAR(upper_normal_tail(deviate), known.p, 0.03 * known.p) << known.ratio;
  }
}

TEST(VarianceRatio, ExchangingTheEstimatesTurnsTheSign) {
  EXPECT_NEAR(variance_ratio_deviate(2.5, 12.0, 30.0), -variance_ratio_deviate(0.4, 30.0, 12.0),
              1e-12);
}

TEST(VarianceRatio, NormalTail) {
  EXPECT_DOUBLE_EQ(upper_normal_tail(0.0), 0.5);
  EXPECT_NEAR(upper_normal_tail(1.6448536269514722), 0.05, 1e-15);
  EXPECT_NEAR(upper_normal_tail(6.0) / 9.865876450376946e-10, 1.0, 1e-12);
}

}  // namespace
}  // namespace loopscope::core::loop
