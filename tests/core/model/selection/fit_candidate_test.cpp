#include "core/model/selection/fit_candidate.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/model/effects/external_oscillation.hpp"
#include "core/model/fit/trial.hpp"
#include "core/model/selection/stepwise_model.hpp"
#include "tests/core/model/model_records.hpp"

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

}  // namespace
}  // namespace loopscope::core::model
