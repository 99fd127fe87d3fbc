#include "core/model/effects/gain_change.hpp"

#include <gtest/gtest.h>

#include "core/model/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

Fit fitted(const LoopData& data, std::size_t at, std::size_t until) {
  return evaluate(data, tests::structure_of(tests::noiseless_process(),
                                            {std::make_shared<GainChange>(at, until)}));
}

LoopData changed(const simulate::GainChange& change) {
  const simulate::LoopRecord record = tests::noiseless_loop(change, 5.0);
  return make_loop_data(record.pv, record.op, 1.0);
}

TEST(GainChange, FindsTheSimulatedRatio) {
  for (const double ratio : {0.4, 0.8, 1.5, 2.5}) {
    const LoopData data = changed({.at_s = 2000.0, .ratio = ratio});
    const Fit fit = fitted(data, 2000, 2000);
    const auto parameters = tests::last_parameters(data, fit);
    EXPECT_NEAR(tests::value_of(parameters, "ratio"), ratio, 0.02 * ratio);
    EXPECT_EQ(tests::value_of(parameters, "at"), 2000.0);
    EXPECT_TRUE(std::isnan(tests::value_of(parameters, "rate")));
    tests::expect_words(*fit.structure.effects.back(), parameters);
  }
}

/// From gain 1 to 2.5 within 2000 s: 1.5 / (2000 / 3600) per hour.
TEST(GainChange, FindsTheSimulatedDrift) {
  const LoopData data = changed({.at_s = 1000.0, .ratio = 2.5, .rate_per_hour = 2.7});
  const Fit fit = fitted(data, 1000, 3000);
  const auto parameters = tests::last_parameters(data, fit);
  EXPECT_NEAR(tests::value_of(parameters, "ratio"), 2.5, 0.05);
  EXPECT_NEAR(tests::value_of(parameters, "rate"), 2.7, 0.1);
  tests::expect_words(*fit.structure.effects.back(), parameters);
}

TEST(GainChange, NoChangeHasRatioOne) {
  const LoopData data = changed({.at_s = 2000.0, .ratio = 1.0});
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fitted(data, 2000, 2000)), "ratio"), 1.0,
              1e-4);
}

TEST(GainChange, RefiningFindsThePlace) {
  const LoopData data = changed({.at_s = 2000.0, .ratio = 2.5});
  const Fit fit = refine_last(data, fitted(data, 1920, 1920));
  // The setpoint rests for 97 samples between its moves: the gain shows at the next of them.
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "at"), 2000.0, 97.0);
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "ratio"), 2.5, 0.15);
}

TEST(GainChange, ColumnsAndNeighbours) {
  tests::expect_columns(GainChange(500, 500));
  tests::expect_columns(GainChange(0, 1000));
  tests::expect_neighbours(GainChange(500, 500));
  tests::expect_neighbours(GainChange(300, 700));
  for (const EffectPtr& neighbour : GainChange(500, 500).neighbours(0.5)) {
    EXPECT_TRUE(std::isnan(
        tests::value_of(neighbour->parameters(LoopData(), tests::Series{0.1}, 1.0), "rate")))
        << "a sudden change stays sudden";
  }
}

}  // namespace
}  // namespace loopscope::core::model
