#include "core/model/effects/external_oscillation.hpp"

#include <gtest/gtest.h>

#include "core/model/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

Fit fitted(const LoopData& data, double period_samples) {
  return evaluate(data,
                  tests::structure_of(tests::noiseless_process(),
                                      {std::make_shared<ExternalOscillation>(period_samples)}));
}

LoopData oscillating(double period_s, double amplitude, double interval_s) {
  const simulate::LoopRecord record = tests::noiseless_loop(
      simulate::ExternalOscillation{.period_s = period_s, .amplitude = amplitude}, 5.0);
  return make_loop_data(record.pv, record.op, interval_s);
}

TEST(ExternalOscillation, FindsTheSimulatedAmplitude) {
  for (const double period : {7.3, 100.0, 811.0}) {
    const LoopData data = oscillating(period, 2.0, 1.0);
    const Fit fit = fitted(data, period);
    EXPECT_LT(fit.score_error, 1e-9);
    const auto parameters = tests::last_parameters(data, fit);
    EXPECT_NEAR(tests::value_of(parameters, "amplitude"), 2.0, 1e-3);
    EXPECT_NEAR(tests::value_of(parameters, "period_s"), period, 1e-9);
    tests::expect_words(*fit.structure.effects.back(), parameters);
  }
}

TEST(ExternalOscillation, ItsPeriodIsInSeconds) {
  const LoopData data = oscillating(100.0, 2.0, 5.0);
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fitted(data, 100.0)), "period_s"), 500.0,
              1e-9);
}

TEST(ExternalOscillation, RefiningFindsThePeriod) {
  const LoopData data = oscillating(100.0, 2.0, 1.0);
  for (const double start : {99.2, 100.7}) {
    const Fit fit = refine_last(data, fitted(data, start));
    EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "period_s"), 100.0, 0.1)
        << start;
  }
}

TEST(ExternalOscillation, ColumnsAndNeighbours) {
  tests::expect_columns(ExternalOscillation(33.0));
  tests::expect_neighbours(ExternalOscillation(33.0));
  for (const double period : {2.5, 33.0, 1000.0}) {
    for (const EffectPtr& neighbour : ExternalOscillation(period).neighbours(1.0)) {
      EXPECT_NEAR(dynamic_cast<const ExternalOscillation&>(*neighbour).period_samples() / period,
                  1.0, 0.2);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::model
