#include "core/hos/literature/cumulants.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "tests/core/hos/bispectrum_of_linear_process.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

constexpr std::size_t kLags = 4;

double at(const Eigen::MatrixXd& cumulant, Eigen::Index t1, Eigen::Index t2) {
  const auto lags = static_cast<Eigen::Index>(kLags);
  return cumulant(lags + t1, lags + t2);
}

TEST(HosCumulants, ZeroLagIsTheThirdCentralMoment) {
  const std::vector<double> x = {1.0, 2.0, 2.0, 7.0};  // mean 3, deviations -2 -1 -1 4
  const auto cumulant = third_order_cumulant(x, kLags);
  EXPECT_NEAR(at(cumulant, 0, 0), (-8.0 - 1.0 - 1.0 + 64.0) / 4.0, 1e-14);
  EXPECT_NEAR(at(cumulant, 1, 0), (4.0 * -1.0 + 1.0 * -1.0 + 1.0 * 4.0) / 3.0, 1e-14);
  EXPECT_NEAR(at(cumulant, 3, 1), -2.0 * -1.0 * 4.0, 1e-14);
  EXPECT_EQ(at(cumulant, 4, 0), 0.0);  // no triple spans it
}

TEST(HosCumulants, HasTheSymmetriesOfAStationarySignal) {
  const auto cumulant = third_order_cumulant(tests::exponential_noise(41, 500), kLags);
  for (Eigen::Index t1 = -4; t1 <= 4; ++t1) {
    for (Eigen::Index t2 = -4; t2 <= 4; ++t2) {
      EXPECT_EQ(at(cumulant, t1, t2), at(cumulant, t2, t1));
      if (std::abs(t1 - t2) > 4) {
        EXPECT_EQ(at(cumulant, t1, t2), 0.0);
      } else {
        EXPECT_EQ(at(cumulant, t1, t2), at(cumulant, -t2, t1 - t2));
        EXPECT_EQ(at(cumulant, t1, t2), at(cumulant, t2 - t1, -t1));
      }
    }
  }
}

TEST(HosCumulants, OfAMovingAverageIsThatOfItsTaps) {
  // c3(t1, t2) = mu_3 sum h(n) h(n + t1) h(n + t2). With 2^16 samples the standard error of such
  // a mean is about sqrt(15) / 256 = 0.015 per unit of variance^1.5; exponential tails double it.
  const std::vector<double> taps = {1.0, -0.6, 0.3};
  const auto x = tests::moving_average(tests::exponential_noise(42, 1 << 16), taps);
  const auto cumulant = third_order_cumulant(x, kLags);
  const auto tap = [&](Eigen::Index n) {
    return n >= 0 && n < 3 ? taps[static_cast<std::size_t>(n)] : 0.0;
  };
  for (Eigen::Index t1 = -4; t1 <= 4; ++t1) {
    for (Eigen::Index t2 = -4; t2 <= 4; ++t2) {
      double expected = 0.0;
      for (Eigen::Index n = 0; n < 3; ++n) {
        expected += 2.0 * tap(n) * tap(n + t1) * tap(n + t2);
      }
      EXPECT_NEAR(at(cumulant, t1, t2), expected, 0.15) << t1 << ' ' << t2;
    }
  }
}

TEST(HosCumulants, TriplesWithAMissingSampleAreLeftOut) {
  const double missing = std::nan("");
  const std::vector<double> x = {-1.0, 1.0, missing, 3.0, -3.0, missing};  // mean 0
  const auto cumulant = third_order_cumulant(x, kLags);
  EXPECT_NEAR(at(cumulant, 0, 0), (-1.0 + 1.0 + 27.0 - 27.0) / 4.0, 1e-14);
  EXPECT_NEAR(at(cumulant, 1, 0), (1.0 * 1.0 + 9.0 * -3.0) / 2.0, 1e-14);
  EXPECT_NEAR(at(cumulant, 3, 1), -1.0 * 1.0 * 3.0, 1e-14);
}

TEST(HosCumulants, EmptyWithoutASample) {
  EXPECT_EQ(third_order_cumulant({}, kLags).size(), 0);
  EXPECT_EQ(third_order_cumulant(std::vector<double>(9, std::nan("")), kLags).size(), 0);
}

}  // namespace
}  // namespace loopscope::core::hos
