#include "core/plant/correlation_p.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::plant {
namespace {

TEST(FisherCombination, OfOneIsThatOne) {
  EXPECT_NEAR(fisher_combined_p(std::array{0.03}), 0.03, 1e-12);
}

TEST(FisherCombination, OfTwoIsTheAreaUnderTheHyperbola) {
  // Pr(u v <= c) = c - c ln c.
  const double c = 0.2 * 0.05;
  EXPECT_NEAR(fisher_combined_p(std::array{0.2, 0.05}), c - c * std::log(c), 1e-12);
  EXPECT_EQ(fisher_combined_p(std::array{1.0, 1.0}), 1.0);
}

TEST(FisherCombination, TakesAZero) {
  EXPECT_LT(fisher_combined_p(std::array{0.0, 1.0, 1.0}), 1e-200);
}

TEST(Correlation, FollowsStudentsLaw) {
  // Twelve pairs with r: t = r sqrt(8 / (1 - r^2)), and the 5 % quantile of t with 8 degrees of
  // freedom is 1.8595, which is r = 0.5494.
  const double r = 1.8595 / std::sqrt(8.0 + 1.8595 * 1.8595);
  std::vector<double> x, y;
  for (int k = 0; k < 12; ++k) {
    const double angle = 2.0 * 3.14159265358979324 * k / 12.0;
    x.push_back(std::cos(angle));
    y.push_back(r * std::cos(angle) + std::sqrt(1.0 - r * r) * std::sin(angle));
  }
  EXPECT_NEAR(correlation_p(x, y, 2.0), 0.05, 1e-4);
  for (double& value : y) value = -value;
  EXPECT_NEAR(correlation_p(x, y, 2.0), 0.95, 1e-4);
}

TEST(Correlation, NeedsPairsThatVary) {
  EXPECT_EQ(correlation_p(std::vector<double>(7, 1.0), std::vector<double>(7, 1.0), 0.0), 1.0);
  EXPECT_EQ(correlation_p(std::vector<double>(20, 1.0), std::vector<double>(20, 1.0), 0.0), 1.0);
}

}  // namespace
}  // namespace loopscope::core::plant
