#include "core/model/effects/square_root_outflow.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/model/fit/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kTimeConstant = 10.0;  // samples at rest

/// Level of a vessel (in % of op, gain 1 at rest) a hundred Euler steps a sample.
LoopData vessel(double depth) {
  const tests::Series op = tests::sum(tests::stepping_op(2000, 1), tests::white_noise(2000, 2));
  const tests::Series flow = make_loop_data(op, op, 1.0).op;
  tests::Series level(flow.size());
  double x = flow.front();
  for (std::size_t k = 1; k < flow.size(); ++k) {
    for (int i = 0; i < 100; ++i) {
      const double outflow = 2.0 * depth * (std::sqrt(1.0 + x / depth) - 1.0);
      x += 0.01 / kTimeConstant * (flow[k - 1] - outflow);
    }
    level[k] = x;
  }
  return make_loop_data(level, op, 1.0);
}

Structure structure(std::vector<EffectPtr> effects) {
  return tests::structure_of(tests::one_lag(std::exp(-1.0 / kTimeConstant), 1), effects);
}

TEST(SquareRootOutflow, LowersTheErrorOfAVessel) {
  const LoopData data = vessel(60.0);
  const double straight = evaluate(data, structure({})).score_error;
  const Fit fit = evaluate(data, structure({std::make_shared<SquareRootOutflow>(60.0)}));
  EXPECT_LT(fit.score_error, 0.01 * straight);
}

TEST(SquareRootOutflow, RefiningFindsTheCurvature) {
  const LoopData data = vessel(60.0);
  const Fit fit =
      refine_last(data, evaluate(data, structure({std::make_shared<SquareRootOutflow>(40.0)})));
  // x = f + f^2 / (4 D), and c / 50 = 1 / (4 D) at gain 1.
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "curvature"), 50.0 / 240.0, 0.03);
}

TEST(SquareRootOutflow, ADeepVesselIsStraight) {
  const ProcessShape shape = tests::one_lag(0.9, 2);
  const tests::Series flow = tests::sum(tests::stepping_op(500, 1), tests::Series(500, -50.0));
  const tests::Series response = answer(shape, flow);
  std::vector<Column> columns;
  SquareRootOutflow(1e8).add_columns({flow, response, shape}, columns);
  for (const double value : columns.front()) EXPECT_NEAR(value, 0.0, 1e-4);
}

TEST(SquareRootOutflow, ColumnsNeighboursAndWords) {
  tests::expect_columns(SquareRootOutflow(50.0));
  tests::expect_columns(SquareRootOutflow(5.0));
  tests::expect_neighbours(SquareRootOutflow(50.0));
  tests::expect_words(SquareRootOutflow(50.0), {{"curvature", "", 0.4, {}, {}}});
}

}  // namespace
}  // namespace loopscope::core::model
