#include "core/model/fit/fit.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/model/effects/load_step.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kWindow;

struct Arma {
  ProcessShape shape = tests::one_lag(0.8, 3);
  NoiseModel noise = tests::kNoise;
  double gain = 1.5;
  double deviation = 0.5;
};

LoopData simulated(const Arma& truth, std::uint64_t seed) {
  const tests::Series op = tests::stepping_op(kWindow, seed);
  const tests::Series noise =
      tests::coloured_noise(truth.noise, kWindow, seed + 1, truth.deviation);
  return make_loop_data(tests::process_record(truth.shape, truth.gain, op, noise), op, 1.0);
}

TEST(Fit, KnownGainsComeBackExactlyWithoutNoise) {
  const tests::Series op = tests::stepping_op(kWindow, 1);
  ProcessShape taps = tests::one_lag(0.8, 3);
  taps.numerator = {3.0, -2.0};
  for (const ProcessShape& shape : {tests::one_lag(0.8, 3), tests::two_lags(0.95, 0.7, 1), taps,
                                    tests::one_lag(0.0, 10), tests::integrator(2)}) {
    const LoopData data = make_loop_data(
        tests::process_record(shape, -0.7, op, tests::Series(kWindow, 0.0)), op, 1.0);
    const Fit fit = evaluate(data, tests::structure_of(shape));
    EXPECT_NEAR(fit.gain() * data.pv_scale, -0.7, 1e-5);
    EXPECT_LT(fit.fit_error, 1e-9);
    EXPECT_LT(fit.score_error, 1e-9);
  }
}

TEST(Fit, ANumeratorComesBack) {
  const tests::Series op = tests::stepping_op(kWindow, 1);
  ProcessShape shape = tests::one_lag(0.8, 3);
  shape.numerator = {1.45 / 0.45, -1.0 / 0.45};
  const LoopData data =
      make_loop_data(tests::process_record(shape, 2.25, op, tests::Series(kWindow, 0.0)), op, 1.0);
  const Fit fit = evaluate(data, tests::structure_of(shape));
  EXPECT_NEAR(fit.structure.process.numerator[0], shape.numerator[0], 1e-4);
  EXPECT_NEAR(fit.structure.process.numerator[1], shape.numerator[1], 1e-4);
}

/// Other units of pv and op are the same model.
TEST(Fit, ShiftedAndScaledRecordsGiveTheSameModel) {
  const tests::Series op = tests::stepping_op(kWindow, 1);
  const Arma truth;
  const tests::Series noise = tests::coloured_noise(truth.noise, kWindow, 2, 0.5);
  const tests::Series pv = tests::process_record(truth.shape, 1.5, op, noise);
  Structure structure = tests::structure_of(truth.shape);
  structure.noise = truth.noise;
  const Fit fit = evaluate(make_loop_data(pv, op, 1.0), structure);
  for (const double unit : {1e-6, 0.01, 1e6}) {
    for (const double zero : {-3.0, 0.0, 200.0}) {
      const tests::Series other =
          tests::sum(tests::scaled(pv, unit), tests::Series(kWindow, zero * unit));
      const tests::Series moved = tests::sum(op, tests::Series(kWindow, zero));
      const Fit same = evaluate(make_loop_data(other, moved, 1.0), structure);
      EXPECT_NEAR(same.fit_error / fit.fit_error, 1.0, 1e-6);
      EXPECT_NEAR(same.score_error / fit.score_error, 1.0, 1e-6);
      EXPECT_NEAR(same.gain(), fit.gain(), 1e-6);
    }
  }
}

TEST(Fit, ErrorsAreTheMeanSquaresOfTheInnovations) {
  const LoopData data = simulated({}, 5);
  const Fit fit = evaluate(data, tests::structure_of(tests::one_lag(0.8, 3)));
  ASSERT_EQ(fit.innovations.size(), kWindow);
  double sum = 0.0;
  for (const Range& range : data.rows.score) {
    for (std::size_t k = range.first; k < range.end; ++k) sum += std::pow(fit.innovations[k], 2);
  }
  EXPECT_NEAR(fit.score_error, sum / static_cast<double>(data.rows.score_count()), 1e-12);
}

TEST(Fit, LeastSquaresIsBestOnTheFitRows) {
  const LoopData data = simulated({}, 6);
  const Structure structure = tests::structure_of(tests::one_lag(0.8, 3));
  const Fit plain = evaluate(data, structure);
  Structure more = structure;
  more.effects = {std::make_shared<LoadStep>(1000)};
  EXPECT_LE(evaluate(data, more).fit_error, plain.fit_error);
}

/// fit_error of the truth is the variance of w, in scaled units; so is the score of rows unseen.
TEST(Fit, TheTruthLeavesTheInnovations) {
  const Arma truth;
  double fitted = 0.0, scored = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LoopData data = simulated(truth, seed);
    Structure structure = tests::structure_of(truth.shape);
    structure.noise = truth.noise;
    const Fit fit = evaluate(data, structure);
    fitted += fit.fit_error * data.pv_scale * data.pv_scale / 10.0;
    scored += fit.score_error * data.pv_scale * data.pv_scale / 10.0;
  }
  EXPECT_NEAR(fitted, 0.25, 0.01);
  EXPECT_NEAR(scored, 0.25, 0.01);
}

Structure random_structure(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Structure structure;
  const bool integrating = uniform(engine) < 0.3;
  structure.second_order = uniform(engine) < 0.5;
  structure.two_taps = uniform(engine) < 0.5;
  structure.process = {.delay_samples = 1 + static_cast<std::size_t>(9.0 * uniform(engine)),
                       .integrating = integrating,
                       .pole = integrating ? 1.0 : 0.98 * uniform(engine),
                       .second_pole = structure.second_order ? 0.9 * uniform(engine) : 0.0};
  structure.noise = {1, {uniform(engine), 0.0, 0.0}, {-(0.9 * uniform(engine)), 0.0, 0.0}};
  if (uniform(engine) < 0.5)
    structure.noise = extended(structure.noise, 0.8 * uniform(engine), 0.3);
  return structure;
}

TEST(Fit, PolishIsNeverWorse) {
  std::mt19937_64 engine(3);
  const LoopData data = simulated({}, 7);
  for (int trial = 0; trial < 60; ++trial) {
    const Structure structure = random_structure(engine);
    const Fit before = evaluate(data, structure);
    const Fit after = polish(data, structure);
    EXPECT_LE(after.fit_error, before.fit_error * (1.0 + 1e-12));
    EXPECT_TRUE(std::isfinite(after.score_error));
    EXPECT_EQ(after.structure.process.delay_samples, structure.process.delay_samples);
  }
}

/// What it can beat it does; what is out of reach it does not go on for.
TEST(Fit, PolishIsGivenUpWhereItCannotWin) {
  const LoopData data = simulated({}, 8);
  const Structure structure = tests::structure_of(tests::one_lag(0.5, 3));
  const double before = evaluate(data, structure).fit_error;
  const double best = polish(data, structure).fit_error;
  ASSERT_LT(best, 0.99 * before);
  EXPECT_EQ(polish(data, structure, 8, 1.001 * best).fit_error, best);
  EXPECT_EQ(polish(data, structure, 8, 1e-6 * best).fit_error, before);
}

TEST(Fit, NoIterationsIsEvaluate) {
  const LoopData data = simulated({}, 8);
  const Structure structure = tests::structure_of(tests::one_lag(0.5, 3));
  EXPECT_EQ(polish(data, structure, 0).innovations, evaluate(data, structure).innovations);
}

/// From roots far off; the tolerances are about four standard errors of one record's estimate.
TEST(Fit, PolishFindsPoleAndRootsOfASimulatedRecord) {
  for (const NoiseModel& noise : {NoiseModel{1, {0.95, 0.0, 0.0}, {-0.4, 0.0, 0.0}},
                                  NoiseModel{1, {0.9, 0.0, 0.0}, {0.3, 0.0, 0.0}}}) {
    const Arma truth{.noise = noise};
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Structure start = tests::structure_of(tests::one_lag(0.5, 3));
      start.noise = {1, {0.7, 0.0, 0.0}, {-0.2, 0.0, 0.0}};
      const Fit fit = polish(simulated(truth, seed), start, 30);
      EXPECT_NEAR(fit.structure.process.pole, 0.8, 0.015) << seed;
      EXPECT_NEAR(fit.structure.noise.poles[0], noise.poles[0], 0.06) << seed;
      EXPECT_NEAR(fit.structure.noise.zeros[0], noise.zeros[0], 0.12) << seed;
    }
  }
}

TEST(Fit, TheModelRunOnOpIsPvWithoutNoise) {
  const tests::Series op = tests::stepping_op(kWindow, 1);
  for (const ProcessShape& shape : {tests::one_lag(0.8, 3), tests::integrator(2)}) {
    const LoopData data =
        make_loop_data(tests::process_record(shape, 1.5, op, tests::Series(kWindow, 0.0)), op, 1.0);
    Structure structure = tests::structure_of(shape);
    structure.noise = {1, {0.9, 0.0, 0.0}, {-0.3, 0.0, 0.0}};
    const tests::Series output = deterministic_output(data, evaluate(data, structure));
    for (std::size_t k = 0; k < kWindow; ++k) EXPECT_NEAR(output[k], data.pv[k], 1e-3) << k;
  }
}

/// Seen at every ninth sample, from op at every one.
TEST(Fit, AHeldSensorShowsTheProcessAtTheRateOfOp) {
  const tests::Series op = tests::stepping_op(kWindow, 1);
  for (const ProcessShape& truth :
       {tests::one_lag(0.85, 5), tests::two_lags(0.95, 0.8, 2), tests::integrator(4)}) {
    const tests::Series pv =
        tests::process_record(truth, 1.5, op, tests::white_noise(kWindow, 2, 0.02));
    const LoopData data = make_loop_data(pv, op, 1.0, {9, 2});
    Structure start = tests::structure_of(truth);
    start.process.pole = truth.integrating ? 1.0 : truth.pole - 0.05;
    const Fit fit = polish(data, start, 12);
    EXPECT_EQ(fit.innovations.size(), data.size());
    EXPECT_NEAR(fit.structure.process.pole, truth.pole, 0.01);
    EXPECT_NEAR(fit.gain() * data.pv_scale, 1.5, 0.02);
    EXPECT_EQ(deterministic_output(data, fit).size(), data.size());
  }
}

}  // namespace
}  // namespace loopscope::core::model
