#include "core/loop/performance.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/loop/signals.hpp"

namespace loopscope::core::loop {
namespace {

using signal::ControlMode;
using signals::Series;

TEST(Performance, GathersItsParts) {
  signals::Random random(1);
  const Series error = signals::ar1(random, 4096, 0.9);
  const Performance result = measure_performance(error, {}, {}, 1.0);
  EXPECT_NEAR(*result.error_std, 1.0 / std::sqrt(0.19), 0.2);  // scatter 3.5 %
  EXPECT_LT(*result.harris_low, *result.harris_high);
  EXPECT_FALSE(result.valve_travel_per_h || result.reversals_per_h || result.auto_fraction ||
               result.at_limit_fraction);
}

TEST(Performance, RatesArePerHourOfRecordedPairs) {
  // A triangle of 1 % per sample that turns every 10 samples, sampled every 10 s: 360 pairs/h.
  Series op(1001);
  for (std::size_t k = 0; k < op.size(); ++k) {
    const auto phase = static_cast<double>(k % 20);
    op[k] = phase < 10.0 ? phase : 20.0 - phase;
  }
  const Performance whole = measure_performance({}, op, {}, 10.0);
  EXPECT_NEAR(*whole.valve_travel_per_h, 360.0, 1e-9);
  EXPECT_NEAR(*whole.reversals_per_h, 36.0, 0.5);
  for (std::size_t k = 500; k < op.size(); ++k) op[k] = std::nan("");
  const Performance half = measure_performance({}, op, {}, 10.0);
  EXPECT_NEAR(*half.valve_travel_per_h, 360.0, 1e-9);
  EXPECT_NEAR(*half.reversals_per_h, 36.0, 1.0);
}

TEST(Performance, FractionsLeaveOutWhatIsUnknown) {
  const std::vector<ControlMode> mode{ControlMode::automatic, ControlMode::cascade,
                                      ControlMode::manual, ControlMode::unknown};
  const Series op{0.2, 50.0, 99.7, std::nan("")};
  const Performance known = measure_performance({}, op, mode, 1.0);
  EXPECT_DOUBLE_EQ(*known.auto_fraction, 2.0 / 3.0);
  const std::vector<ControlMode> unknown(4, ControlMode::unknown);
  const Performance other = measure_performance({}, op, unknown, 1.0);
  EXPECT_FALSE(other.auto_fraction);
}

}  // namespace
}  // namespace loopscope::core::loop
