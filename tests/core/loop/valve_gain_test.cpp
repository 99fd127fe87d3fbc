#include "core/loop/valve_gain.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace loopscope::core::loop {
namespace {

TEST(ValveGain, SpansOfARamp) {
  std::vector<double> op;
  std::vector<double> pv;
  for (int k = 0; k <= 1000; ++k) {
    op.push_back(49.4 + 0.6 * k / 1000.0);
    pv.push_back(100.0 + 20.0 * k / 1000.0);
  }
  const ValveGain gain = measure_valve_gain(pv, op);
  EXPECT_NEAR(*gain.op_span_percent, 0.98 * 0.6, 1e-9);
  EXPECT_NEAR(*gain.pv_relative_span, 0.98 * 20.0 / 110.0, 1e-9);
}

TEST(ValveGain, OneSpikeIsNoSwing) {
  std::vector<double> op(1000, 50.0);
  op[500] = 100.0;
  EXPECT_EQ(*measure_valve_gain(op, op).op_span_percent, 0.0);
}

TEST(ValveGain, NothingRecordedNothingClaimed) {
  const std::vector<double> missing(10, std::numeric_limits<double>::quiet_NaN());
  const ValveGain gain = measure_valve_gain(missing, {});
  EXPECT_FALSE(gain.op_span_percent.has_value());
  EXPECT_FALSE(gain.pv_relative_span.has_value());
  EXPECT_FALSE(measure_valve_gain(std::vector<double>(5, 0.0), {}).pv_relative_span.has_value());
}

}  // namespace
}  // namespace loopscope::core::loop
