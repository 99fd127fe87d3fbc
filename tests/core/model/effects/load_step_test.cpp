#include "core/model/effects/load_step.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/model/fit/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kIntervalS = 1.0;

LoopData stepped(double size, double interval_s) {
  simulate::LoopRecord record =
      tests::noiseless_loop(simulate::LoadStep{.at_s = 1500.0 * kIntervalS, .size = size}, 5.0);
  return make_loop_data(record.pv, record.op, interval_s);
}

TEST(LoadStep, FindsTheSimulatedSizeInPvUnits) {
  for (const double size : {-12.0, 0.5, 4.0}) {
    const LoopData data = stepped(size, 1.0);
    const Fit fit = tests::fit_noiseless(data, std::make_shared<LoadStep>(1500));
    EXPECT_LT(fit.score_error, 1e-9);
    const auto parameters = tests::last_parameters(data, fit);
    EXPECT_NEAR(tests::value_of(parameters, "size"), size, 1e-3);
    EXPECT_NEAR(tests::value_of(parameters, "at"), 1500.0, 1e-9);
    tests::expect_words(*fit.structure.effects.back(), parameters);
  }
}

TEST(LoadStep, ItsTimeIsInSeconds) {
  const LoopData data = stepped(4.0, 5.0);
  EXPECT_NEAR(
      tests::value_of(tests::last_parameters(
                          data, tests::fit_noiseless(data, std::make_shared<LoadStep>(1500))),
                      "at"),
      7500.0, 1e-9);
}

/// A load that passes the process's own lag leaves nothing either.
TEST(LoadStep, FindsAStepThroughTheLag) {
  const tests::Series op = tests::stepping_op(2000, 1);
  tests::Series load(2000, 0.0);
  for (std::size_t k = 900; k < 2000; ++k) load[k] = 3.0;
  lag(0.9, load);
  const ProcessShape shape = tests::one_lag(0.9, 2);
  const LoopData data = make_loop_data(tests::process_record(shape, 1.5, op, load), op, 1.0);
  const Fit fit = evaluate(data, tests::structure_of(shape, {std::make_shared<LoadStep>(900)}));
  EXPECT_LT(fit.score_error, 1e-9);
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "size"), 3.0, 1e-2);
}

/// Whatever the lag, also of a vessel's load that is no ramp of its level.
TEST(LoadStep, RefiningFindsAStepThroughALagOfItsOwn) {
  const tests::Series op = tests::stepping_op(2000, 1);
  for (const double lag_samples : {1.0, 4.0, 12.0}) {
    for (const bool integrating : {false, true}) {
      tests::Series load(2000, 0.0);
      for (std::size_t k = 900; k < 2000; ++k) load[k] = 3.0;
      lag(std::exp(-1.0 / lag_samples), load);
      ProcessShape shape = tests::one_lag(0.9, 2);
      if (integrating) shape = {.delay_samples = 2, .integrating = true, .pole = 1.0};
      const LoopData data = make_loop_data(tests::process_record(shape, 1.5, op, load), op, 1.0);
      const Fit start =
          evaluate(data, tests::structure_of(shape, {std::make_shared<LoadStep>(903)}));
      const Fit fit = refine_last(data, start);
      EXPECT_LT(fit.fit_error, 1e-6) << lag_samples << integrating;
      EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "size"), 3.0, 0.1)
          << lag_samples << integrating;
    }
  }
}

TEST(LoadStep, RefiningFindsThePlace) {
  const LoopData data = stepped(6.0, 1.0);
  for (const std::size_t start : {1494U, 1507U}) {
    const Fit fit =
        refine_last(data, tests::fit_noiseless(data, std::make_shared<LoadStep>(start)));
    EXPECT_EQ(tests::value_of(tests::last_parameters(data, fit), "at"), 1500.0) << start;
  }
}

TEST(LoadStep, ColumnsAndNeighbours) {
  tests::expect_columns(LoadStep(500));
  tests::expect_neighbours(LoadStep(500));
  tests::expect_columns(LoadStep(0));
  tests::expect_columns(LoadStep(500, 1, 4.0));
  tests::expect_neighbours(LoadStep(500, 1, 4.0));
  tests::expect_columns(LoadStep(999999));
  for (const EffectPtr& neighbour : LoadStep(0).neighbours(1.0)) {
    EXPECT_LT(*neighbour->moment(), 100U);
  }
}

/// Where pv is seen at every eighth sample only, a place moves by rows.
TEST(LoadStep, OfAHeldSensorRefiningFindsTheRow) {
  const simulate::LoopRecord record =
      tests::noiseless_loop(simulate::LoadStep{.at_s = 1500.0 * kIntervalS, .size = 6.0}, 5.0);
  const LoopData data = make_loop_data(record.pv, record.op, 1.0, {8, 0});
  for (const std::size_t start : {1472U, 1536U}) {
    const auto effect = std::make_shared<LoadStep>(start, 8);
    const Fit fit = refine_last(
        data, evaluate(data, tests::structure_of(tests::noiseless_process(), {effect})));
    EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "at"), 1500.0, 8.0) << start;
  }
}

}  // namespace
}  // namespace loopscope::core::model
