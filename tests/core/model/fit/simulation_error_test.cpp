#include "core/model/fit/simulation_error.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kWindow;

double error_of(const tests::Series& disturbance, double pole) {
  const tests::Series op = tests::stepping_op(kWindow, 1);
  const tests::Series pv = tests::process_record(tests::one_lag(0.8, 3), 1.5, op, disturbance);
  const LoopData data = make_loop_data(pv, op, 1.0);
  const Fit fit = evaluate(data, tests::structure_of(tests::one_lag(pole, 3)));
  return simulation_error(data, fit) * data.pv_scale * data.pv_scale;
}

TEST(SimulationError, TheTruthLeavesNothing) {
  EXPECT_LT(error_of(tests::Series(kWindow, 0.0), 0.8), 1e-6);
}

TEST(SimulationError, WhiteNoiseLeavesItsVariance) {
  EXPECT_NEAR(error_of(tests::white_noise(kWindow, 3), 0.8), 1.0, 0.1);
}

/// Offset and slow drift are no error of the model.
TEST(SimulationError, ACubicDriftCostsNothing) {
  tests::Series drift(kWindow), drifting;
  for (std::size_t k = 0; k < kWindow; ++k) {
    const double t = static_cast<double>(k) / kWindow;
    drift[k] = 2.0 + 3.0 * t - 8.0 * t * t + 5.0 * t * t * t;
  }
  const tests::Series noise = tests::white_noise(kWindow, 3, 0.1);
  EXPECT_NEAR(error_of(tests::sum(noise, drift), 0.8), error_of(noise, 0.8), 0.002);
}

TEST(SimulationError, AWrongPoleCosts) {
  const tests::Series noise = tests::white_noise(kWindow, 3, 0.3);
  EXPECT_GT(error_of(noise, 0.3), 2.0 * error_of(noise, 0.8));
}

}  // namespace
}  // namespace loopscope::core::model
