#include "core/model/effects/input_load.hpp"

#include <gtest/gtest.h>

#include "core/model/fit/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

/// A load of 3 before the process, at once or along a ramp.
LoopData loaded(const ProcessShape& shape, std::size_t at, std::size_t until) {
  const tests::Series op = tests::stepping_op(2000, 1);
  tests::Series load(2000, 0.0);
  for (std::size_t k = at; k < 2000; ++k) {
    const double share = static_cast<double>(k - at) / static_cast<double>(until - at);
    load[k] = until == at ? 3.0 : 3.0 * std::min(1.0, share);
  }
  return make_loop_data(tests::process_record(shape, 1.5, op, answer(shape, load)), op, 1.0);
}

void expect_found(const ProcessShape& shape, std::size_t at, std::size_t until) {
  const LoopData data = loaded(shape, at, until);
  // The load meets the dead time too.
  const auto load =
      std::make_shared<InputLoad>(at + shape.delay_samples, until + shape.delay_samples);
  const Fit fit = evaluate(data, tests::structure_of(shape, {load}));
  EXPECT_LT(fit.score_error, 1e-9);
  const auto parameters = tests::last_parameters(data, fit);
  EXPECT_NEAR(tests::value_of(parameters, "size"), 3.0, 1e-3);
  EXPECT_EQ(tests::value_of(parameters, "at"), static_cast<double>(at + shape.delay_samples));
  tests::expect_words(*load, parameters);
}

TEST(InputLoad, PassesTheLagsOfTheProcess) {
  expect_found(tests::two_lags(0.9, 0.5, 3), 900, 900);
  expect_found(tests::one_lag(0.8, 1), 900, 1400);
}

TEST(InputLoad, FillsAVessel) {
  expect_found(tests::integrator(3), 900, 900);
}

TEST(InputLoad, Columns) {
  tests::expect_columns(InputLoad(500, 500));
  tests::expect_columns(InputLoad(0, 1000));
}

}  // namespace
}  // namespace loopscope::core::model
