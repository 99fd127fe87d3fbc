#include "core/model/fit/baseline.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/model/effects/saturation.hpp"
#include "core/model/fit/process_report.hpp"
#include "core/model/fit/trial.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kWindow;
constexpr std::uint64_t kBaselineRecords = 5;
using tests::kNoise;

LoopData record_of(const ProcessShape& shape, double gain, std::uint64_t seed) {
  const tests::Series op = tests::stepping_op(kWindow, seed);
  const tests::Series noise = tests::coloured_noise(kNoise, kWindow, seed + 100, 0.3);
  return make_loop_data(tests::process_record(shape, gain, op, noise), op, 1.0);
}

Structure first_guess() {
  Structure start;
  start.noise = {1, {0.95, 0.0, 0.0}, {-0.3, 0.0, 0.0}};
  return start;
}

TEST(Baseline, FindsDelayGainAndTimeConstant) {
  for (const std::size_t delay : {1U, 4U, 15U}) {
    for (std::uint64_t seed = 1; seed <= kBaselineRecords; ++seed) {
      const LoopData data = record_of(tests::one_lag(0.9, delay), -1.3, seed);
      const ProcessFit found = report_process(data, search_process(data, first_guess()));
      EXPECT_FALSE(found.integrating) << delay << " " << seed;
      EXPECT_EQ(found.delay_s, static_cast<double>(delay)) << seed;
      EXPECT_NEAR(found.gain, -1.3, 0.1) << seed;
      EXPECT_NEAR(found.time_constant_s, -1.0 / std::log(0.9), 1.0) << seed;
    }
  }
}

/// Whatever the order that it chose: delay, gain and mean answer are those of the two lags.
TEST(Baseline, FindsTwoLags) {
  for (std::uint64_t seed = 1; seed <= kBaselineRecords; ++seed) {
    const LoopData data = record_of(tests::two_lags(0.95, 0.8, 3), 1.5, seed);
    const Fit fit = search_process(data, first_guess());
    EXPECT_NEAR(fit.gain() * data.pv_scale, 1.5, 0.15) << seed;
    Structure truth = tests::structure_of(tests::two_lags(0.95, 0.8, 3));
    truth.noise = kNoise;
    EXPECT_LT(fit.score_error, 1.02 * evaluate(data, truth).score_error) << seed;
  }
}

TEST(Baseline, KnowsAnIntegrator) {
  int integrating = 0;
  for (std::uint64_t seed = 1; seed <= kBaselineRecords; ++seed) {
    const tests::Series op = tests::stepping_op(kWindow, seed);
    const tests::Series noise = tests::white_noise(kWindow, seed + 100, 0.05);
    const LoopData data =
        make_loop_data(tests::process_record(tests::integrator(3), 0.02, op, noise), op, 1.0);
    const Fit fit = search_process(data, first_guess());
    integrating += fit.structure.process.integrating;
    EXPECT_LT(fit.score_error * data.pv_scale * data.pv_scale, 1.1 * 0.0025) << seed;
  }
  EXPECT_GE(integrating, static_cast<int>(kBaselineRecords) - 1);
}

TEST(Baseline, NeverWithoutADelayAndWithinItsLimits) {
  const LoopData data = record_of(tests::one_lag(0.9, 1), 1.0, 1);
  for (const std::size_t longest : {1U, 5U, 25U}) {
    const Fit fit = search_process(data, first_guess(), {.longest_delay = longest, .starts = 1});
    EXPECT_GE(fit.structure.process.delay_samples, 1U);
    EXPECT_LE(fit.structure.process.delay_samples, longest + 2);  // neighbours are tried
  }
}

TEST(Baseline, ALaterSearchIsNoWorseThanItsBestStart) {
  const LoopData data = record_of(tests::one_lag(0.9, 4), 1.0, 2);
  const double few = search_process(data, first_guess(), {.starts = 1}).fit_error;
  EXPECT_LE(search_process(data, first_guess(), {.starts = 4}).fit_error, few * 1.01);
}

TEST(Baseline, SettlingIsNeverWorseAndFindsTheNextDelay) {
  const LoopData data = record_of(tests::one_lag(0.9, 4), 1.0, 3);
  for (const std::size_t delay : {3U, 4U, 5U}) {
    Structure structure = tests::structure_of(tests::one_lag(0.9, delay));
    structure.noise = kNoise;
    const Fit start = evaluate(data, structure);
    const Fit settled = settle(data, start);
    EXPECT_LE(settled.fit_error, start.fit_error);
    EXPECT_EQ(settled.structure.process.delay_samples, 4U);
  }
}

/// A bent flow that is right glances better than the straight one.
TEST(Baseline, AGlanceSeesTheSaturation) {
  tests::Series op = tests::stepping_op(kWindow, 1), flow = op;
  for (double& value : flow) value = std::min(value, 53.0);
  const LoopData data = make_loop_data(
      tests::process_record(tests::one_lag(0.8, 3), 1.5, flow, tests::white_noise(kWindow, 2, 0.2)),
      op, 1.0);
  Structure structure = first_guess();
  const auto glanced_error = [&] {
    structure.process = glance(data, structure);
    return evaluate(data, structure).fit_error;
  };
  const double straight = glanced_error();
  structure.effects = {std::make_shared<Saturation>(-100.0, 53.0 - data.op_mean)};
  const double bent = glanced_error();
  EXPECT_GT(gain_of(data, straight, bent), 100.0);
  EXPECT_EQ(structure.process.pole, 0.8);
  EXPECT_EQ(structure.process.delay_samples, 3U);
}

}  // namespace
}  // namespace loopscope::core::model
