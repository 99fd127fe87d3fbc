#include "core/simulate/scenario.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

namespace loopscope::core::simulate {
namespace {

double error_std(std::string_view scenario, std::uint64_t seed) {
  const std::vector<double> error = control_error(simulate_scenario(scenario, {}, seed));
  double square = 0.0;
  for (const double value : error) {
    square += value * value / static_cast<double>(error.size());
  }
  return std::sqrt(square);
}

TEST(Scenario, NamesAreUniqueAndEveryOneRuns) {
  std::set<std::string_view> names;
  ScenarioOptions options;
  options.samples = 600;
  for (const Scenario& scenario : all_scenarios()) {
    EXPECT_TRUE(names.insert(scenario.name).second) << scenario.name;
    const LoopRecord record = simulate_scenario(scenario.name, options, 1);
    EXPECT_EQ(record.sp.size(), 600U);
    EXPECT_EQ(record.pv.size(), 600U);
    EXPECT_EQ(record.op.size(), scenario.is_loop ? 600U : 0U) << scenario.name;
    EXPECT_EQ(record.mv.size(), record.op.size());
    EXPECT_EQ(simulate_scenario(scenario.name, options, 1).pv, record.pv);
  }
}

TEST(Scenario, AddedEffectsStandBesideItsOwn) {
  ScenarioOptions options;
  options.added_effects = {SensorQuantisation{1.0}};
  for (const double pv : simulate_scenario("paper_5_4", options, 1).pv) {
    ASSERT_EQ(pv, std::round(pv));
  }
  EXPECT_EQ(scenario_loop("paper_5_4", options).effects.size(), 2U);
  EXPECT_THROW((void)simulate_scenario("paper_4_1_linear", options, 1), std::invalid_argument);
}

TEST(Scenario, TheIntervalChangesTheClockAndNotTheRecord) {
  // Effects in seconds scale along, so that a period stays the same number of samples.
  for (const std::string_view name : {"paper_5_3", "outside_oscillation", "load_upsets"}) {
    ScenarioOptions slow;
    slow.sample_interval_s = 60.0;
    const LoopRecord record = simulate_scenario(name, slow, 2);
    EXPECT_EQ(record.sample_interval_s, 60.0);
    const LoopRecord fast = simulate_scenario(name, {}, 2);
    for (std::size_t k = 0; k < fast.pv.size(); ++k) {
      ASSERT_NEAR(record.pv[k], fast.pv[k], 1e-9) << name;
    }
  }
}

TEST(Scenario, FaultyFlowLoopsAreWorseThanTheHealthyOne) {
  const double healthy = error_std("healthy_flow", 1);
  for (const std::string_view faulty : {"tight_tuning", "sluggish_tuning", "sticking_valve",
                                        "square_limit_cycle", "oversized_valve", "saturated_valve",
                                        "outside_oscillation", "load_upsets", "holding_sensor"}) {
    EXPECT_GT(error_std(faulty, 1), 1.5 * healthy) << faulty;
  }
}

TEST(Scenario, UnknownNamesAreRefused) {
  EXPECT_THROW((void)simulate_scenario("paper_5_5", {}, 1), std::invalid_argument);
  EXPECT_THROW((void)scenario_loop("paper_4_1_linear"), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::simulate
