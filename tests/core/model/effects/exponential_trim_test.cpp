#include "core/model/effects/exponential_trim.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/model/fit/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kTravel = 20.0;  // %

/// The flow of an equal percentage trim of slope 1 at the mean of op.
LoopData through_trim(double growth_per_percent) {
  const tests::Series op = tests::sum(tests::stepping_op(2000, 1), tests::white_noise(2000, 2));
  tests::Series flow = make_loop_data(op, op, 1.0).op;
  for (double& value : flow) value = std::expm1(growth_per_percent * value) / growth_per_percent;
  return make_loop_data(answer(tests::one_lag(0.6, 2), flow), op, 1.0);
}

Fit fit_trim(const LoopData& data, double growth) {
  return evaluate(data, tests::structure_of(tests::one_lag(0.6, 2),
                                            {std::make_shared<ExponentialTrim>(growth, kTravel)}));
}

TEST(ExponentialTrim, IsAnEqualPercentageTrim) {
  for (const double growth : {-0.03, 0.01, 0.03}) {
    const LoopData data = through_trim(growth);
    EXPECT_LT(fit_trim(data, growth * kTravel).score_error, 1e-8) << growth;
  }
}

TEST(ExponentialTrim, RefiningFindsTheGrowth) {
  for (const double growth : {-0.025, 0.025}) {
    const LoopData data = through_trim(growth);
    const Fit fit = refine_last(data, fit_trim(data, std::copysign(0.4, growth)));
    // f'' / 2 f' at 50 %, over half a span of 50: the same wherever op rests.
    EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "curvature"), 25.0 * growth,
                0.02);
  }
}

TEST(ExponentialTrim, WithoutGrowthItIsAParabola) {
  const LoopData data = through_trim(0.02);
  EXPECT_NEAR(fit_trim(data, 0.0).score_error, fit_trim(data, 1e-3).score_error, 1e-6);
}

TEST(ExponentialTrim, ColumnsNeighboursAndWords) {
  tests::expect_columns(ExponentialTrim(0.4, kTravel));
  tests::expect_columns(ExponentialTrim(0.0, kTravel));
  tests::expect_neighbours(ExponentialTrim(0.4, kTravel));
  tests::expect_words(ExponentialTrim(0.4, kTravel), {{"curvature", "", 0.4, {}, {}}});
}

}  // namespace
}  // namespace loopscope::core::model
