#include "core/model/effects/saturation.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "core/model/fit/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

simulate::LoopRecord saturated() {
  return tests::noiseless_loop(simulate::ValveSaturation{.low_percent = 46.0, .high_percent = 53.0},
                               6.0);
}

Structure with_limits(const LoopData& data, double low, double high) {
  return tests::structure_of(
      tests::noiseless_process(),
      {std::make_shared<Saturation>(low - data.op_mean, high - data.op_mean)});
}

TEST(Saturation, HoldsTheFlowBetweenItsLimits) {
  tests::Series flow{-30.0, -10.0, 0.0, 4.0, 30.0};
  Saturation(-10.0, 4.0).shape_flow(flow);
  EXPECT_EQ(flow, (tests::Series{-10.0, -10.0, 0.0, 4.0, 4.0}));
  Saturation(-kNone, kNone).shape_flow(flow);
  EXPECT_EQ(flow.front(), -10.0);
}

TEST(Saturation, IsThatOfTheSimulatedValve) {
  const simulate::LoopRecord record = saturated();
  const LoopData data = make_loop_data(record.pv, record.op, 1.0);
  const Fit fit = evaluate(data, with_limits(data, 46.0, 53.0));
  EXPECT_LT(fit.score_error, 1e-9);
  EXPECT_NEAR(fit.gain() * data.pv_scale, tests::kNoiselessGain, 1e-4);
  const auto parameters = tests::last_parameters(data, fit);
  EXPECT_NEAR(tests::value_of(parameters, "low"), 46.0, 1e-9);
  EXPECT_NEAR(tests::value_of(parameters, "high"), 53.0, 1e-9);
  tests::expect_words(*fit.structure.effects.back(), parameters);
}

TEST(Saturation, ALimitThatIsNotThereIsTheEndOfTheTravel) {
  LoopData data;
  data.op_mean = 40.0;
  const auto parameters = Saturation(-kNone, 15.0).parameters(data, {}, 1.0);
  EXPECT_EQ(tests::value_of(parameters, "low"), 0.0);
  EXPECT_EQ(tests::value_of(parameters, "high"), 55.0);
}

TEST(Saturation, RefiningFindsTheLimit) {
  const simulate::LoopRecord record = tests::noiseless_loop(
      simulate::ValveSaturation{.low_percent = 0.0, .high_percent = 53.0}, 6.0);
  const LoopData data = make_loop_data(record.pv, record.op, 1.0);
  for (const double start : {52.1, 54.4}) {
    const Fit fit = refine_last(data, evaluate(data, with_limits(data, -kNone, start)));
    EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "high"), 53.0, 0.1) << start;
  }
}

TEST(Saturation, Neighbours) {
  tests::expect_neighbours(Saturation(-3.0, 4.0));
  tests::expect_columns(Saturation(-3.0, 4.0));
  for (const EffectPtr& neighbour : Saturation(-3.0, kNone).neighbours(1.0)) {
    LoopData data;
    data.op_mean = 50.0;
    EXPECT_EQ(tests::value_of(neighbour->parameters(data, {}, 1.0), "high"), 100.0);
  }
}

}  // namespace
}  // namespace loopscope::core::model
