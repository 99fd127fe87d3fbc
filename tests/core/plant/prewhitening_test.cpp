#include "core/plant/prewhitening.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

#include "core/hos/numeric/normal_draw.hpp"

namespace loopscope::core::plant {
namespace {

TEST(OwnPast, LeavesTheInnovationsOfASecondOrderSeries) {
  std::mt19937_64 random(1);
  std::vector<double> series{0.0, 0.0}, fresh{0.0, 0.0};
  for (std::size_t k = 2; k < 4000; ++k) {
    fresh.push_back(hos::normal_draw(random));
    series.push_back(1.2 * series[k - 1] - 0.5 * series[k - 2] + fresh.back());
  }
  const std::vector<double> left = without_own_past(series);
  double off = 0.0;
  for (std::size_t k = 2; k < left.size(); ++k) off += std::pow(left[k] - fresh[k], 2.0);
  // Two coefficients and a mean cost three parts in 4000.
  EXPECT_LT(off / 4000.0, 0.005);
}

TEST(OwnPast, KeepsHolesAndUnknownStarts) {
  std::mt19937_64 random(2);
  std::vector<double> series;
  for (int k = 0; k < 50; ++k) series.push_back(hos::normal_draw(random));
  series[20] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> left = without_own_past(series);
  for (const std::size_t k : {0U, 1U, 20U, 21U, 22U}) EXPECT_TRUE(std::isnan(left[k])) << k;
  EXPECT_TRUE(std::isfinite(left[23]));
}

TEST(OwnPast, SaysNothingOfConstantsAndShortSeries) {
  for (const std::size_t length : {0U, 1U, 2U, 9U, 100U})
    for (const double value : without_own_past(std::vector<double>(length, 3.0)))
      EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace loopscope::core::plant
