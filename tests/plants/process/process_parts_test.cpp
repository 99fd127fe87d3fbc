#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

#include "tests/plants/process/evaporator.hpp"
#include "tests/plants/process/signals.hpp"
#include "tests/plants/process/simulate.hpp"
#include "tests/plants/process/spectrum.hpp"
#include "tests/plants/process/stability.hpp"
#include "tests/plants/process/valve.hpp"

namespace loopscope::tests::process {
namespace {

ValvePlan bare_valve(Friction friction) {
  ValvePlan plan;
  plan.friction = friction;
  plan.actuator_lag_s = 0.0;
  plan.play = 4.0;
  plan.stick = 4.0;
  plan.slide = 1.0;
  return plan;
}

TEST(ProcessValve, PlayIsTakenUpBeforeTheStemMoves) {
  Valve valve(bare_valve(Friction::play), 1.0, 50.0);
  EXPECT_EQ(valve.step(51.9), 50.0);
  EXPECT_EQ(valve.step(55.0), 53.0);
  EXPECT_EQ(valve.step(51.5), 53.0);
  EXPECT_EQ(valve.step(50.0), 52.0);
}

TEST(ProcessValve, StickingStemsWaitAndThenSlip) {
  for (const Friction friction : {Friction::jump, Friction::stribeck}) {
    Valve valve(bare_valve(friction), 1.0, 50.0);
    for (double op = 50.0; op <= 53.9; op += 0.1) EXPECT_EQ(valve.step(op), 50.0);
    double stem = 0.0;
    for (int k = 0; k < 20; ++k) stem = valve.step(54.2);
    EXPECT_GT(stem, 51.5);
    EXPECT_LE(stem, 53.3);
    EXPECT_NEAR(valve.step(54.0), stem, 0.02) << "it sticks again";
  }
}

TEST(ProcessSignals, NoiseHasTheDeviationThatItPromises) {
  for (const bool twice : {false, true}) {
    FilteredNoise noise(20.0, twice, 1.0, 7);
    double squares = 0.0;
    for (int k = 0; k < 200000; ++k) {
      const double value = noise.step();
      squares += value * value / 200000.0;
    }
    EXPECT_NEAR(squares, 1.0, 0.1);
  }
}

TEST(ProcessSignals, ASensorIsSetRightOnceAPeriod) {
  Sawtooth sawtooth({.size = 2.0, .period_s = 50.0, .wander = 0.1}, 1.0, 3);
  int resets = 0;
  double before = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double now = sawtooth.step();
    if (now < before - 0.5) ++resets;
    EXPECT_LE(std::abs(now), 2.5);
    before = now;
  }
  EXPECT_NEAR(resets, 100, 8);
}

TEST(ProcessSignals, AWaveLeavesTheNoiseAsItWas) {
  UpsetPlan plan;
  plan.sd = 1.0;
  plan.memory_s = 30.0;
  Upset calm(plan, 1.0, 5);
  plan.wave = {.period_s = 40.0, .amplitude = 2.0, .wander = 0.0};
  Upset waving(plan, 1.0, 5);
  double largest = 0.0;
  for (int k = 0; k < 400; ++k) largest = std::max(largest, std::abs(waving.step() - calm.step()));
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(largest, 2.0 * 1.7 + 1e-9);
}

TEST(ProcessSpectrum, FindsALineInNoise) {
  Random random(1);
  std::vector<double> series;
  for (int k = 0; k < 3000; ++k)
    series.push_back(0.01 * k + std::sin(2.0 * std::numbers::pi * k / 37.0) +
                     0.5 * random.normal());
  const Spectrum spectrum(series);
  EXPECT_NEAR(1.0 / spectrum.strongest(4.0 / 3000.0), 37.0, 2.0);
  EXPECT_NEAR(spectrum.line_power(1.0 / 37.0) / spectrum.total(), 0.5 / 0.75 + 0.06, 0.12);
}

TEST(ProcessStability, ALoopSwingsUpBeyondItsLimitOnly) {
  const PlantPlan plan = draft_evaporator(4);
  const auto content = std::ranges::find(plan.loops, "AIC-2", &LoopPlan::name);
  const auto loop = static_cast<std::size_t>(content - plan.loops.begin());
  const std::optional<double> limit = factor_at_limit(plan, loop, Knob::gain);
  ASSERT_TRUE(limit.has_value());
  EXPECT_GT(*limit, 1.2) << "a sound loop has some room";
  const auto factor_of = [&](double factor) {
    PlantPlan tighter = plan;
    tighter.loops[loop] = tightened(plan.loops[loop], Knob::gain, factor);
    return factor_at_limit(tighter, loop, Knob::gain);
  };
  EXPECT_NEAR(factor_of(0.8 * *limit).value_or(0.0), 1.25, 0.1);
  EXPECT_FALSE(factor_of(1.2 * *limit).has_value()) << "it swings already";
}

TEST(ProcessSimulation, WindowsEndWhereTheyShould) {
  const PlantPlan plan = draft_evaporator(2);
  std::vector<Window> windows(plan.loops.size(), {.samples = 200, .every = 20});
  windows[0] = {.samples = 200, .every = 5, .end_early = 60};
  const std::vector<Record> records = simulate(plan, windows);
  ASSERT_EQ(records.size(), plan.loops.size());
  const auto end_s = [](const Record& record) {
    return record.start_s + record.interval_s * static_cast<double>(record.pv.size());
  };
  EXPECT_NEAR(end_s(records[1]) - end_s(records[0]), 60.0, 40.0);
  for (const Record& record : records) {
    EXPECT_EQ(record.pv.size(), 200U);
    EXPECT_NEAR(std::remainder(record.start_s, record.interval_s), 0.0, 1e-9);
  }
}

TEST(ProcessSimulation, AMastersOutputIsItsSlavesSetpoint) {
  const PlantPlan plan = draft_evaporator(2);
  const std::vector<Record> records = simulate(plan, {.samples = 300, .every = 5});
  std::set<std::string> slaves;
  for (std::size_t i = 0; i < plan.loops.size(); ++i) {
    const LoopPlan& slave = plan.loops[i];
    if (!slave.master) continue;
    slaves.insert(slave.name);
    for (std::size_t k = 0; k < 300; ++k) {
      const double told =
          slave.low + records[*slave.master].op[k] / 100.0 * (slave.high - slave.low);
      EXPECT_NEAR(records[i].sp[k], told, 1e-9);
    }
  }
  EXPECT_TRUE(slaves.contains("PIC-100"));
}

}  // namespace
}  // namespace loopscope::tests::process
