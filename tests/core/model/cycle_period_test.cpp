#include "core/model/cycle_period.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "core/simulate/random.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using tests::sine;

bool holds_period(const std::vector<double>& periods, double period) {
  return std::ranges::any_of(periods, [&](double p) { return std::abs(p / period - 1.0) < 0.1; });
}

TEST(CyclePeriod, OneWhereErrorAndOutputAgree) {
  const auto periods = candidate_periods(sine(2000, 40.0, 0.2), sine(2000, 40.0, 0.1));
  ASSERT_EQ(periods.size(), 1U);
  EXPECT_NEAR(periods.front(), 40.0, 2.0);
}

/// Fewer than nine cycles are too few for the spectrum.
TEST(CyclePeriod, TheTurnsOfTheOutputShowSixCycles) {
  const auto periods = candidate_periods(sine(900, 150.0, 0.3), sine(900, 150.0, 0.05));
  EXPECT_TRUE(holds_period(periods, 150.0));
}

TEST(CyclePeriod, AnOutputThatOnlyDriftsAddsNothing) {
  std::vector<double> drift(1000);
  for (std::size_t k = 0; k < drift.size(); ++k) drift[k] = static_cast<double>(k);
  EXPECT_EQ(candidate_periods(sine(1000, 40.0), drift).size(), 1U);
}

}  // namespace
}  // namespace loopscope::core::model
