#include "core/model/fit/process_report.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using tests::kInterval;

ProcessFit reported(const ProcessShape& shape, double gain) {
  const tests::Series op = tests::stepping_op(2000, 1);
  const tests::Series pv = tests::process_record(shape, gain, op, tests::Series(2000, 0.0));
  const LoopData data = make_loop_data(pv, op, kInterval);
  return report_process(data, evaluate(data, tests::structure_of(shape)));
}

TEST(ProcessReport, SecondsAndPvUnits) {
  const ProcessFit process = reported(tests::one_lag(std::exp(-0.1), 4), -2.5);
  EXPECT_FALSE(process.integrating);
  EXPECT_NEAR(process.gain, -2.5, 1e-4);
  EXPECT_NEAR(process.time_constant_s, 50.0, 1e-6);
  EXPECT_EQ(process.second_time_constant_s, 0.0);
  EXPECT_EQ(process.delay_s, 20.0);
}

TEST(ProcessReport, TheSlowestLagComesFirst) {
  for (const auto& [one, other] : {std::pair{0.1, 0.5}, std::pair{0.5, 0.1}}) {
    const ProcessFit process = reported(tests::two_lags(std::exp(-one), std::exp(-other), 1), 1.0);
    EXPECT_NEAR(process.time_constant_s, 50.0, 1e-6);
    EXPECT_NEAR(process.second_time_constant_s, 10.0, 1e-6);
  }
}

TEST(ProcessReport, AnIntegratorMovesByPercentAndSecond) {
  const ProcessFit process = reported(tests::integrator(2), 0.02);
  EXPECT_TRUE(process.integrating);
  EXPECT_NEAR(process.gain, 0.02 / kInterval, 1e-7);
  EXPECT_EQ(process.time_constant_s, 0.0);
}

TEST(ProcessReport, AnAnswerWithinASampleHasNoTimeConstant) {
  EXPECT_EQ(reported(tests::one_lag(0.0, 1), 1.0).time_constant_s, 0.0);
}

TEST(ProcessReport, TheLineNamesOrderGainAndDelay) {
  const tests::Series op = tests::stepping_op(2000, 1);
  const ProcessShape shape = tests::one_lag(0.9, 4);
  const LoopData data = make_loop_data(
      tests::process_record(shape, 2.5, op, tests::Series(2000, 0.0)), op, kInterval);
  EXPECT_EQ(describe(data, evaluate(data, tests::structure_of(shape))),
            "one lag, gain 2.5 pv per %, time constant 47.5 s, delay 20 s, noise with poles 0 and "
            "numerator 1, 0");
}

}  // namespace
}  // namespace loopscope::core::model
