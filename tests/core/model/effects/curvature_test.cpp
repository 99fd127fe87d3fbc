#include "core/model/effects/curvature.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

struct Judged {
  LoopData data;
  Fit fit;
  double curvature;
};

template <typename CurvedEffect>
Judged judged(const simulate::Effect& effect, double move) {
  const simulate::LoopRecord record = tests::noiseless_loop(effect, move);
  Judged result{make_loop_data(record.pv, record.op, 1.0), {}, 0.0};
  result.fit = evaluate(result.data, tests::structure_of(tests::noiseless_process(),
                                                         {std::make_shared<CurvedEffect>()}));
  result.curvature = tests::value_of(tests::last_parameters(result.data, result.fit), "curvature");
  return result;
}

TEST(ValveCharacteristic, FindsTheSimulatedCurvature) {
  for (const double curvature : {-0.4, -0.1, 0.2, 0.45}) {
    const auto found =
        judged<ValveCharacteristic>(simulate::ValveCharacteristic{.curvature = curvature}, 15.0);
    EXPECT_LT(found.fit.score_error, 1e-8) << curvature;
    EXPECT_NEAR(found.curvature, curvature, 0.01 * std::abs(curvature)) << curvature;
  }
}

TEST(ValveCharacteristic, AStraightValveHasNone) {
  const auto found =
      judged<ValveCharacteristic>(simulate::ValveDeadband{.width_percent = 0.0}, 15.0);
  EXPECT_NEAR(found.curvature, 0.0, 1e-4);
}

/// c of y + c y^2 / 50 about the mean: expanded about another point than 50 it is c / slope^2.
TEST(ProcessNonlinearity, FindsTheSimulatedCurvature) {
  for (const double curvature : {-0.6, -0.2, 0.3, 0.8}) {
    const auto found =
        judged<ProcessNonlinearity>(simulate::ProcessNonlinearity{.curvature = curvature}, 8.0);
    const double answer = tests::kNoiselessGain * (found.data.op_mean - 50.0);
    const double slope = 1.0 + 2.0 * curvature * answer / 50.0;
    EXPECT_LT(found.fit.score_error, 1e-6) << curvature;
    EXPECT_NEAR(found.curvature, curvature / (slope * slope), 0.03 * std::abs(curvature))
        << curvature;
  }
}

TEST(ProcessNonlinearity, AStraightProcessHasNone) {
  const auto found =
      judged<ProcessNonlinearity>(simulate::ValveDeadband{.width_percent = 0.0}, 8.0);
  EXPECT_NEAR(found.curvature, 0.0, 1e-4);
}

/// Curvature is a ratio: other units of pv about the same point leave that of the valve alone.
TEST(ValveCharacteristic, IsTheSameInAnyUnit) {
  const simulate::LoopRecord record =
      tests::noiseless_loop(simulate::ValveCharacteristic{.curvature = 0.3}, 15.0);
  const LoopData data = make_loop_data(tests::scaled(record.pv, 1e6), record.op, 1.0);
  const Fit fit = evaluate(data, tests::structure_of(tests::noiseless_process(),
                                                     {std::make_shared<ValveCharacteristic>()}));
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "curvature"), 0.3, 0.003);
}

TEST(Curvature, ColumnsAndWords) {
  tests::expect_columns(ValveCharacteristic());
  tests::expect_columns(ProcessNonlinearity());
  EXPECT_TRUE(ValveCharacteristic().neighbours(1.0).empty());
  EXPECT_TRUE(ProcessNonlinearity().neighbours(1.0).empty());
  tests::expect_words(ValveCharacteristic(), {{"curvature", "", 0.4, {}, {}}});
  tests::expect_words(ProcessNonlinearity(), {{"curvature", "", 0.4, {}, {}}});
}

}  // namespace
}  // namespace loopscope::core::model
