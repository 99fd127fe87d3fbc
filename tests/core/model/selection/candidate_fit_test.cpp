#include "core/model/selection/candidate_fit.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/model/effects/external_oscillation.hpp"
#include "core/model/fit/trial.hpp"
#include "core/model/selection/stepwise_model.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kWanderingSamples = 4000;
constexpr double kWanderingPeriod = 40.0, kWanderingNoiseStd = 0.2;

/// A wave at the output whose phase wanders, and op as a controller answers it: nearly all that op
/// does is that answer.
LoopData answered_wave(std::uint64_t seed) {
  const ProcessShape process = tests::one_lag(0.9, 3);
  tests::Series op = tests::coloured_noise({}, kWanderingSamples, seed, 0.6);
  tests::Series load =
      tests::coloured_noise(tests::kNoise, kWanderingSamples, seed + 50, kWanderingNoiseStd);
  for (std::size_t k = 0; k < kWanderingSamples; ++k) {
    const auto time = static_cast<double>(k);
    const double angle =
        2.0 * std::numbers::pi * time / kWanderingPeriod + 6.0 * std::sin(time / 600.0);
    op[k] += 50.0 - 2.0 * std::sin(angle - 0.6);
    load[k] += 2.0 * std::sin(angle);
  }
  return make_loop_data(tests::process_record(process, 1.5, op, load), op, 1.0);
}

TEST(FitAnew, FindsTheProcessBehindAWaveWhosePhaseWanders) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const LoopData data = answered_wave(seed);
    const Fit linear = start_selection(data).last().fit;
    const auto line = std::make_shared<ExternalOscillation>(kWanderingPeriod);
    const Fit fit = fit_candidate(data, evaluate(data, with(linear.structure, line)), HUGE_VAL);
    const double floor = std::pow(kWanderingNoiseStd / data.pv_scale, 2.0);
    EXPECT_GT(linear.fit_error, 1.2 * floor) << seed;
    EXPECT_LT(fit.fit_error, 1.1 * floor) << seed;
  }
}

using loopscope::tests::kWindow;

/// A lag of pole 0.8 under noise that remembers with this pole.
LoopData record(double noise_pole, std::uint64_t seed = 3) {
  const tests::Series op = tests::stepping_op(kWindow, 1);
  tests::Series noise = tests::white_noise(kWindow, seed);
  for (std::size_t k = 1; k < kWindow; ++k) noise[k] += noise_pole * noise[k - 1];
  return make_loop_data(tests::process_record(tests::one_lag(0.8, 3), 1.5, op, noise), op, 1.0);
}

Fit fit_of(const LoopData& data, double process_pole, double noise_pole) {
  Structure structure = tests::structure_of(tests::one_lag(process_pole, 3));
  structure.noise.poles = {noise_pole, 0.0, 0.0};
  structure.noise.zeros = {0.0, 0.0, 0.0};
  return evaluate(data, structure);
}

double rows_apart(const LoopData& data) {
  return static_cast<double>(data.rows.score_count()) / 10.0;
}

/// The error ten ahead of the right noise has the variance (1 - 0.9^20) / (1 - 0.81); that of a
/// model without memory is the noise itself, 1 / (1 - 0.81), and a little of gain and offset, which
/// it fits as if the noise were white.
TEST(MultiStepError, MemoryIsWorthWhatTheoryGives) {
  constexpr std::uint64_t kSeeds = 30;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const LoopData data = record(0.9, seed);
    sum += multi_step_evidence(data, fit_of(data, 0.8, 0.0), fit_of(data, 0.8, 0.9)) /
           rows_apart(data);
  }
  EXPECT_GT(sum / kSeeds, -std::log1p(-std::pow(0.9, 20)));
  EXPECT_LT(sum / kSeeds, -std::log1p(-std::pow(0.9, 20)) + 0.06);
}

/// Without memory every error is one step's.
TEST(MultiStepError, WithoutMemoryItIsTheOneStepRatio) {
  const LoopData data = record(0.0);
  const Fit wrong = fit_of(data, 0.3, 0.0);
  const Fit right = fit_of(data, 0.8, 0.0);
  const double one_step = std::log(wrong.score_error / right.score_error);
  const double evidence = multi_step_evidence(data, wrong, right);
  EXPECT_NEAR(evidence / rows_apart(data), one_step, 0.2 * one_step);
  EXPECT_NEAR(multi_step_evidence(data, right, wrong), -evidence, 1e-9 * evidence);
}

/// A wrong process whose errors the noise remembers costs little one row ahead, and more further.
TEST(MultiStepError, AWrongProcessShowsFurtherAhead) {
  const LoopData data = record(0.9);
  const Fit wrong = fit_of(data, 0.3, 0.9);
  const Fit right = fit_of(data, 0.8, 0.9);
  const double one_step = std::log(wrong.score_error / right.score_error);
  EXPECT_GT(multi_step_evidence(data, wrong, right) / rows_apart(data), 1.5 * one_step);
}

TEST(MultiStepError, OfItselfItIsNothing) {
  const LoopData data = record(0.5);
  const Fit fit = fit_of(data, 0.8, 0.5);
  EXPECT_EQ(multi_step_evidence(data, fit, fit), 0.0);
}

}  // namespace
}  // namespace loopscope::core::model
