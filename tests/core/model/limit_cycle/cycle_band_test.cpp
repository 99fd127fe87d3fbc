#include "core/model/limit_cycle/cycle_band.hpp"

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

double amplitude(const std::vector<double>& signal) {
  double sum = 0.0;
  for (const double value : signal) sum += value * value;
  return std::sqrt(2.0 * sum / static_cast<double>(signal.size()));
}

TEST(CycleBand, LeavesTwentyToFortySamplesACycle) {
  for (const double period : {20.0, 39.0, 41.0, 100.0, 777.0}) {
    const CycleBand band(period);
    EXPECT_GE(band.period(), 20.0) << period;
    EXPECT_LT(band.period(), 40.0) << period;
  }
  EXPECT_EQ(CycleBand(9.0).factor(), 1U);
}

TEST(CycleBand, AveragesAndDropsTheRest) {
  const CycleBand band(40.0);
  EXPECT_EQ(band.resample(std::vector{1.0, 3.0, 5.0, 7.0, 9.0}), (std::vector{2.0, 6.0}));
}

TEST(CycleBand, PassesTheCycleAndNotTheDrift) {
  const CycleBand band(30.0);
  // (mean of 5) - (mean of 75) at a period of 30: 0.956 - 0.127.
  EXPECT_NEAR(amplitude(band.pass(sine(3000, 30.0))), 0.83, 0.02);
  EXPECT_LT(amplitude(band.pass(sine(3000, 600.0))), 0.05);
  EXPECT_NEAR(amplitude(band.pass(sine(3000, 3.0))), 0.2, 0.02);
  EXPECT_LT(amplitude(band.pass(std::vector(500, 7.0))), 1e-9);
}

TEST(CycleBand, TheDriftIsWhatItTakesOut) {
  const CycleBand band(30.0);
  for (const double value : band.drift(std::vector(500, 7.0))) EXPECT_NEAR(value, 7.0, 1e-12);
  EXPECT_GT(amplitude(band.drift(sine(3000, 600.0))), 0.9);
  EXPECT_NEAR(amplitude(band.drift(sine(3000, 30.0))), 0.13, 0.02);
}

bool holds_period(const std::vector<double>& periods, double period) {
  return std::ranges::any_of(periods, [&](double p) { return std::abs(p / period - 1.0) < 0.1; });
}

TEST(CycleBand, OneWhereErrorAndOutputAgree) {
  const auto periods = candidate_periods(sine(2000, 40.0, 0.2), sine(2000, 40.0, 0.1));
  ASSERT_EQ(periods.size(), 1U);
  EXPECT_NEAR(periods.front(), 40.0, 2.0);
}

/// Fewer than nine cycles are too few for the spectrum.
TEST(CycleBand, TheTurnsOfTheOutputShowSixCycles) {
  const auto periods = candidate_periods(sine(900, 150.0, 0.3), sine(900, 150.0, 0.05));
  EXPECT_TRUE(holds_period(periods, 150.0));
}

TEST(CycleBand, AnOutputThatOnlyDriftsAddsNothing) {
  std::vector<double> drift(1000);
  for (std::size_t k = 0; k < drift.size(); ++k) drift[k] = static_cast<double>(k);
  EXPECT_EQ(candidate_periods(sine(1000, 40.0), drift).size(), 1U);
}

}  // namespace
}  // namespace loopscope::core::model
