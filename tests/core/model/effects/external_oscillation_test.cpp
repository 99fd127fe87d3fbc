#include "core/model/effects/external_oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

#include "core/model/fit/trial.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

LoopData oscillating(double period_s, double amplitude, double interval_s) {
  const simulate::LoopRecord record = tests::noiseless_loop(
      simulate::ExternalOscillation{.period_s = period_s, .amplitude = amplitude}, 5.0);
  return make_loop_data(record.pv, record.op, interval_s);
}

TEST(ExternalOscillation, FindsTheSimulatedAmplitude) {
  for (const double period : {7.3, 100.0, 811.0}) {
    const LoopData data = oscillating(period, 2.0, 1.0);
    const Fit fit = tests::fit_noiseless(data, std::make_shared<ExternalOscillation>(period));
    EXPECT_LT(fit.score_error, 1e-9);
    const auto parameters = tests::last_parameters(data, fit);
    EXPECT_NEAR(tests::value_of(parameters, "amplitude"), 2.0, 1e-3);
    EXPECT_NEAR(tests::value_of(parameters, "period_s"), period, 1e-9);
    tests::expect_words(*fit.structure.effects.back(), parameters);
  }
}

TEST(ExternalOscillation, ItsPeriodIsInSeconds) {
  const LoopData data = oscillating(100.0, 2.0, 5.0);
  EXPECT_NEAR(tests::value_of(tests::last_parameters(
                                  data, tests::fit_noiseless(
                                            data, std::make_shared<ExternalOscillation>(100.0))),
                              "period_s"),
              500.0, 1e-9);
}

TEST(ExternalOscillation, RefiningFindsThePeriod) {
  const LoopData data = oscillating(100.0, 2.0, 1.0);
  for (const double start : {99.2, 100.7}) {
    const Fit fit =
        refine_last(data, tests::fit_noiseless(data, std::make_shared<ExternalOscillation>(start)));
    EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "period_s"), 100.0, 0.1)
        << start;
  }
}

/// pv = wave, sampled; op apart from it.
LoopData waving(const std::function<double(double)>& wave, std::size_t samples = 4000) {
  const tests::Series op = tests::stepping_op(samples, 1);
  tests::Series load(samples);
  for (std::size_t k = 0; k < samples; ++k) load[k] = wave(static_cast<double>(k));
  return make_loop_data(tests::process_record(tests::noiseless_process(), 1.2, op, load), op, 1.0);
}

Fit fitted_wave(const LoopData& data, double period, std::size_t harmonics, std::size_t knots) {
  return evaluate(
      data, tests::structure_of(tests::noiseless_process(),
                                {std::make_shared<ExternalOscillation>(period, harmonics, knots)}));
}

double angle(double k, double period) {
  return 2.0 * std::numbers::pi * k / period;
}

TEST(ExternalOscillation, ReportsTheFundamentalOfItsHarmonics) {
  const LoopData data = waving([](double k) {
    return 2.0 * std::sin(angle(k, 60.0)) + 0.7 * std::sin(angle(k, 30.0) + 1.0);
  });
  const Fit fit = fitted_wave(data, 60.0, 2, 0);
  EXPECT_LT(fit.score_error, 1e-9);
  EXPECT_NEAR(tests::value_of(tests::last_parameters(data, fit), "amplitude"), 2.0, 1e-3);
  EXPECT_EQ(tests::value_of(tests::last_parameters(data, fit), "period_s"), 60.0);
  tests::expect_words(*fit.structure.effects.back(), tests::last_parameters(data, fit));
}

/// 100 cycles of the fundamental and one more that the phase gains; the amplitude doubles.
TEST(ExternalOscillation, FollowsAnAmplitudeAndAPhaseThatChange) {
  const LoopData data = waving([](double k) {
    const double share = k / 4000.0;
    return (1.0 + share) * std::sin(angle(k, 40.0) + 2.0 * std::numbers::pi * share * share);
  });
  const Fit constant = fitted_wave(data, 40.0, 1, 0);
  const Fit fit = fitted_wave(data, 40.0, 1, 16);
  EXPECT_LT(fit.score_error, 0.01 * constant.score_error);
  const auto parameters = tests::last_parameters(data, fit);
  EXPECT_NEAR(tests::value_of(parameters, "period_s"), 4000.0 / 101.0, 0.02);
  EXPECT_NEAR(tests::value_of(parameters, "amplitude"), std::sqrt(7.0 / 3.0), 0.03);
  tests::expect_words(*fit.structure.effects.back(), parameters);
}

TEST(ExternalOscillation, StretchesHoldFourCyclesAndAHundredSamples) {
  const auto nets = [](double period) {
    return ExternalOscillation(period).with_knots(4096).size();
  };
  EXPECT_EQ(nets(20.0), 5U);
  EXPECT_EQ(nets(40.0), 4U);
  EXPECT_EQ(nets(300.0), 1U);
}

TEST(ExternalOscillation, MayBeAHarmonicItself) {
  std::vector<double> periods;
  for (const EffectPtr& wave : ExternalOscillation(30.0).with_harmonics())
    periods.push_back(dynamic_cast<const ExternalOscillation&>(*wave).period_samples());
  for (const double period : {30.0, 60.0, 90.0}) {
    EXPECT_TRUE(std::ranges::count(periods, period)) << period;
  }
}

TEST(ExternalOscillation, ColumnsAndNeighbours) {
  tests::expect_columns(ExternalOscillation(33.0));
  tests::expect_columns(ExternalOscillation(33.0, 2, 8));
  tests::expect_neighbours(ExternalOscillation(33.0));
  tests::expect_neighbours(ExternalOscillation(33.0, 2, 8));
  for (const double period : {2.5, 33.0, 1000.0}) {
    for (const EffectPtr& neighbour : ExternalOscillation(period).neighbours(1.0)) {
      EXPECT_NEAR(dynamic_cast<const ExternalOscillation&>(*neighbour).period_samples() / period,
                  1.0, 0.2);
    }
  }
}

/// Samples are made side by side; the last ones may be fewer.
TEST(ExternalOscillation, ItsColumnsAreSineAndCosineAtEverySample) {
  const std::vector<double> flow(4099);
  const ProcessShape process = tests::noiseless_process();
  for (const double period : {3.1, 41.7}) {
    std::vector<Column> columns;
    ExternalOscillation(period).add_columns({flow, flow, process}, columns);
    ASSERT_EQ(columns.size(), 2U);
    for (std::size_t k = 0; k < flow.size(); ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / period;
      ASSERT_NEAR(columns[0][k], std::sin(angle), 1e-10) << k;
      ASSERT_NEAR(columns[1][k], std::cos(angle), 1e-10) << k;
    }
  }
}

TEST(ExternalOscillation, WavesAreTheSameByPeriodHarmonicsAndKnots) {
  const ExternalOscillation wave(40.0, 2, 8);
  EXPECT_TRUE(wave == ExternalOscillation(40.0, 2, 8));
  EXPECT_FALSE(wave == ExternalOscillation(41.0, 2, 8));
  EXPECT_FALSE(wave == ExternalOscillation(40.0, 3, 8));
  EXPECT_FALSE(wave == ExternalOscillation(40.0, 2, 4));
}

TEST(ExternalOscillation, SlowerThanFourCyclesIsADriftAndNoNeighbour) {
  for (const double period : {300.0, 700.0, 1000.0, 1024.0}) {
    const ExternalOscillation wave(period);
    for (const double scale : {0.25, 1.0, 8.0}) {
      for (const EffectPtr& neighbour : wave.neighbours(scale))
        EXPECT_LE(dynamic_cast<const ExternalOscillation&>(*neighbour).period_samples(), 1024.0);
    }
    for (const EffectPtr& wider : wave.with_harmonics())
      EXPECT_LE(dynamic_cast<const ExternalOscillation&>(*wider).period_samples(), 1024.0);
  }
}

}  // namespace
}  // namespace loopscope::core::model
