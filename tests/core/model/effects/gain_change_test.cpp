#include "core/model/effects/gain_change.hpp"

#include <gtest/gtest.h>

#include "core/model/fit/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

LoopData changed(const simulate::GainChange& change) {
  const simulate::LoopRecord record = tests::noiseless_loop(change, 5.0);
  return make_loop_data(record.pv, record.op, 1.0);
}

TEST(GainChange, FindsTheSimulatedRatio) {
  for (const double ratio : {0.4, 0.8, 1.5, 2.5}) {
    const LoopData data = changed({.at_s = 2000.0, .ratio = ratio});
    const Fit fit = tests::fit_noiseless(data, std::make_shared<GainChange>(2000, 2000));
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
  const Fit fit = tests::fit_noiseless(data, std::make_shared<GainChange>(1000, 3000));
  const auto parameters = tests::last_parameters(data, fit);
  EXPECT_NEAR(tests::value_of(parameters, "ratio"), 2.5, 0.05);
  EXPECT_NEAR(tests::value_of(parameters, "rate"), 2.7, 0.1);
  tests::expect_words(*fit.structure.effects.back(), parameters);
}

TEST(GainChange, NoChangeHasRatioOne) {
  const LoopData data = changed({.at_s = 2000.0, .ratio = 1.0});
  EXPECT_NEAR(tests::value_of(
                  tests::last_parameters(
                      data, tests::fit_noiseless(data, std::make_shared<GainChange>(2000, 2000))),
                  "ratio"),
              1.0, 1e-4);
}

/// Its flow is none at 30 %, far from the mean of op: the level that comes with it shows when.
LoopData about_another_point(std::size_t at, double ratio) {
  constexpr std::size_t kSamples = 2000;
  const tests::Series op = tests::stepping_op(kSamples, 1);
  tests::Series more(kSamples, 0.0);
  for (std::size_t k = at; k < kSamples; ++k) more[k] = (ratio - 1.0) * (op[k] - 30.0);
  const ProcessShape shape = tests::one_lag(0.8, 2);
  const tests::Series added = tests::scaled(answer(shape, more), 1.5);
  return make_loop_data(tests::process_record(shape, 1.5, op, added), op, 1.0);
}

TEST(GainChange, TakesALevelWithItAndFindsThePlace) {
  const LoopData data = about_another_point(1000, 1.6);
  for (const std::size_t start : {960U, 1100U}) {
    const Structure structure =
        tests::structure_of(tests::one_lag(0.8, 2), {std::make_shared<GainChange>(start, start)});
    const Fit fit = refine_last(seen_whole(data), evaluate(data, structure));
    EXPECT_LT(fit.score_error, 1e-9);
    const auto parameters = tests::last_parameters(data, fit);
    // at: of pv, two samples of dead time later
    EXPECT_NEAR(tests::value_of(parameters, "at"), 1002.0, 1e-9) << start;
    EXPECT_NEAR(tests::value_of(parameters, "ratio"), 1.6, 1e-3);
  }
}

TEST(GainChange, ItsWorkingPointLiesWhereOpCanBe) {
  const GainChange change(500, 500);
  EXPECT_TRUE(change.plausible(tests::Series{0.5, 49.0}, 1.0));
  EXPECT_TRUE(change.plausible(tests::Series{-0.5, -49.0}, 1.0));
  EXPECT_FALSE(change.plausible(tests::Series{0.5, 51.0}, 1.0));
  EXPECT_FALSE(change.plausible(tests::Series{-0.9, 0.0}, 1.0)) << "nothing of the gain is left";
}

TEST(GainChange, ALoadThatMovesIsPlainer) {
  EXPECT_EQ(GainChange(500, 500).plainer().size(), 2U);
  EXPECT_EQ(GainChange(300, 700).plainer().size(), 1U);
  for (const EffectPtr& plainer : GainChange(500, 500).plainer()) {
    EXPECT_EQ(plainer->kind(), EffectKind::load_step);
  }
}

TEST(GainChange, ColumnsAndNeighbours) {
  tests::expect_columns(GainChange(500, 500));
  tests::expect_columns(GainChange(0, 1000));
  tests::expect_neighbours(GainChange(500, 500));
  tests::expect_neighbours(GainChange(300, 700));
  for (const EffectPtr& neighbour : GainChange(500, 500).neighbours(0.5)) {
    EXPECT_TRUE(std::isnan(
        tests::value_of(neighbour->parameters(LoopData(), tests::Series{0.1, 0.0}, 1.0), "rate")))
        << "a sudden change stays sudden";
  }
}

}  // namespace
}  // namespace loopscope::core::model
