#include "core/model/limit_cycle/limit_cycle_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/model/limit_cycle/limit_cycle_cause.hpp"
#include "core/model/valve_law/valve_law.hpp"
#include "core/simulate/random.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core::model {
namespace {

using Series = std::vector<double>;

Step told_by(ValveLaw law) {
  Step step;
  step.law = name(law);
  return step;
}

double mean_square(const Series& pv, const Series& simulated) {
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (std::isnan(simulated[k])) continue;
    sum += (pv[k] - simulated[k]) * (pv[k] - simulated[k]);
    count += 1.0;
  }
  return sum / count;
}

std::size_t known(const Series& series) {
  return static_cast<std::size_t>(
      std::ranges::count_if(series, [](double value) { return !std::isnan(value); }));
}

simulate::LoopRecord square_cycle(std::size_t samples) {
  simulate::ScenarioOptions options;
  options.samples = samples;
  return simulate::simulate_scenario("square_limit_cycle", options, 1);
}

/// Errors fall as those do that the judge holds out.
TEST(WitnessSimulation, TheCycleIsThatOfTheJudge) {
  const auto record = square_cycle(1200);
  const ModelInput input{record.pv, record.op, record.sp, {}, record.sample_interval_s, true, 1};
  const auto simulation = simulate_limit_cycle(input, told_by(ValveLaw::he));
  ASSERT_TRUE(simulation);
  const CycleEvidence evidence = judge_limit_cycle(record.pv, record.op, record.sp).evidence;
  const double ratio =
      mean_square(record.pv, simulation->valve) / mean_square(record.pv, simulation->linear);
  const double judged =
      std::min(evidence.error_law, evidence.error_turning) / evidence.error_before;
  EXPECT_LT(judged, 0.8) << "there is something to see";
  EXPECT_NEAR(ratio, judged, 0.2) << "fast noise and what is fitted to all of it make the rest";
  EXPECT_GT(known(simulation->valve), record.pv.size() - 40) << "but a rest of less than a mean";
}

TEST(WitnessSimulation, OfALongRecordThreePartsAreLookedAt) {
  const auto record = square_cycle(4096);
  const ModelInput input{record.pv, record.op, record.sp, {}, record.sample_interval_s, true, 1};
  const auto simulation = simulate_limit_cycle(input, told_by(ValveLaw::he));
  ASSERT_TRUE(simulation);
  EXPECT_EQ(known(simulation->valve), known(simulation->linear));
  EXPECT_LT(known(simulation->valve), record.pv.size());
  EXPECT_FALSE(std::isnan(simulation->valve.front()));
}

/// Three strokes of op, of which the valve follows the last part of each alone.
TEST(WitnessSimulation, StrokesAreThoseOfTheSlowTravel) {
  constexpr std::size_t kSamples = 800;
  simulate::GaussianSource noise(3);
  Series op(kSamples), pv(kSamples);
  for (std::size_t k = 0; k < kSamples; ++k) {
    const double turn = 3.0 * std::numbers::pi * static_cast<double>(k) / kSamples;
    op[k] = 25.0 + std::asin(std::sin(turn)) * 2.0 / std::numbers::pi;
  }
  run_valve(ValveLaw::kano, 1.4, 0.4, 1.0, op, pv);
  for (double& value : pv) value = 4.0 * value + 0.1 * noise.next();
  const auto simulation = simulate_limit_cycle({pv, op, {}, {}, 1.0}, told_by(ValveLaw::kano));
  ASSERT_TRUE(simulation);
  EXPECT_LT(mean_square(pv, simulation->valve), 0.2 * mean_square(pv, simulation->linear));
  EXPECT_EQ(known(simulation->valve), kSamples);
}

TEST(WitnessSimulation, NothingToLookAt) {
  const Series still(1000, 1.0);
  for (const ValveLaw law : {ValveLaw::he, ValveLaw::kano})
    EXPECT_FALSE(simulate_limit_cycle({still, still, {}, {}, 1.0}, told_by(law)));
}

}  // namespace
}  // namespace loopscope::core::model
