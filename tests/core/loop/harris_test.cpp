#include "core/loop/harris.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;

constexpr int kHarrisRecords = 30;

TEST(Harris, Ar1HasItsClosedForm) {
  // psi_i = phi^i, so sigma_mv^2 / sigma^2 = 1 - phi^(2 d).
  const double phi = 0.9;
  double low = 0.0, high = 0.0;
  for (int seed = 0; seed < kHarrisRecords; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const auto range = measure_harris(signals::ar1(random, 4096, phi), 2, 10, 20);
    ASSERT_TRUE(range);
    low += range->low / kHarrisRecords;
    high += range->high / kHarrisRecords;
  }
  // One estimate scatters by 0.03 and 0.04 (variance of an AR(1) over 4096 samples), the mean of 30
  // by 0.007.
  EXPECT_NEAR(low, 1.0 - std::pow(phi, 4.0), 0.025);
  EXPECT_NEAR(high, 1.0 - std::pow(phi, 20.0), 0.025);
}

TEST(Harris, WhiteNoiseIsAsGoodAsItGets) {
  for (int seed = 0; seed < kHarrisRecords; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const auto range = measure_harris(signals::white(random, 4096), 2, 10, 20);
    ASSERT_TRUE(range);
    // Twenty coefficients fitted to noise move the index by about 20 / 4096.
    EXPECT_GT(range->low, 0.97);
    EXPECT_GE(range->high, range->low);
  }
}

TEST(Harris, LongerDelayExcusesMore) {
  for (int seed = 0; seed < kHarrisRecords; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Series error = signals::resonance(random, 1000, 30.0, 0.95);
    double before = 0.0;
    for (std::size_t delay = 1; delay <= 12; ++delay) {
      const double index = measure_harris(error, delay, delay, 20)->low;
      EXPECT_GE(index, before);
      EXPECT_LE(index, 1.0);
      before = index;
    }
  }
}

TEST(Harris, SustainedOscillationIsPoor) {
  Random random(1);
  const auto range =
      measure_harris(signals::wave(random, 4096, signals::Wave::sine, 100.0), 2, 10, 20);
  ASSERT_TRUE(range);
  EXPECT_LT(range->high, 0.01);
}

TEST(Harris, SurvivesTenPercentMissing) {
  Random random(2);
  const auto range = measure_harris(
      signals::with_missing(random, signals::ar1(random, 4096, 0.9), 0.1), 2, 10, 20);
  ASSERT_TRUE(range);
  // About 450 unbroken rows are left of 4076: three times the scatter of a whole record.
  EXPECT_NEAR(range->low, 1.0 - std::pow(0.9, 4.0), 0.15);
}

}  // namespace
}  // namespace loopscope::core::loop
