#include "tests/plants/process/evaporator.hpp"
#include "tests/plants/process/plan_maker.hpp"

namespace loopscope::tests::process {
namespace {

void add_supplies(PlanMaker& maker) {
  maker.add_upset(0.15, 200.0, 3000.0);  // x1, %
  maker.add_upset(2.0, 200.0, 3000.0);   // t1, K
  maker.add_upset(1.0, 300.0, 5000.0);   // t200, K
  maker.add_upset(0.4, 60.0, 2000.0);    // inflow, kg/min
  maker.add_upset(0.03, 20.0, 600.0);    // steam header, by its flow
  maker.add_upset(0.03, 20.0, 600.0);    // water header
  maker.add_upset(0.01, 20.0, 300.0);    // feed head
}

void add_streams(PlanMaker& maker) {
  const double steam = Evaporator::stage({}, {}).f100;
  maker.add_stream(10.0, 2.0, Evaporator::kFeedHead);
  maker.add_stream(2.0, 1.5, std::nullopt);
  maker.add_stream(50.0, 3.0, std::nullopt);
  maker.add_stream(208.0, 3.0, Evaporator::kWaterHeader);
  maker.add_stream(steam, 1.0, Evaporator::kSteamHeader);
}

void add_feed(PlanMaker& maker) {
  using E = Evaporator;
  std::size_t feed = 0;
  if (maker.random().chance(0.6)) {
    maker.add_level("LIC-1", E::kFeedTank, 1.0, 2.0, -1.0 / 60.0 / 60.0, E::kF1Feed, "FIC-1",
                    maker.random().chance(0.15));
  } else {
    feed = maker.add_flow_loop("FIC-1", E::kF1Feed);
  }
  const std::size_t circulation = maker.add_flow_loop("FIC-3", E::kF3Circulation);
  const bool flow_is_measured = maker.plan().loops[feed].flow_of.has_value();
  if (flow_is_measured && maker.random().chance(0.5)) maker.set_ratio(circulation, feed);
}

void add_vapour(PlanMaker& maker) {
  using E = Evaporator;
  const Sensor chest{.low = 100.0, .high = 300.0, .lag_s = 2.0, .noise = 0.15};
  const Sensor analyser{
      .low = 15.0, .high = 35.0, .lag_s = 15.0, .dead_time_s = 30.0, .noise = 0.3, .scan_steps = 5};
  const Response of_steam{.gain = 24.8, .time_constant_s = 30.0, .late_s = 4.0};
  const std::size_t p100 =
      maker.add_loop("PIC-100", "pressure", E::kP100, 194.7, chest, of_steam, E::kSteam);
  maker.add_master("AIC-2", "composition", E::kX2, 25.0, analyser,
                   {.gain = 0.45, .time_constant_s = 600.0, .late_s = 180.0}, p100);
}

void add_condenser(PlanMaker& maker) {
  using E = Evaporator;
  const Sensor sensor{.low = 35.0, .high = 65.0, .lag_s = 4.0, .noise = 0.1};
  const Response response{.gain = -0.0328, .time_constant_s = 1070.0, .late_s = 20.0};
  if (maker.random().chance(0.25)) {
    maker.add_loop("PIC-2", "pressure", E::kP2, 50.5, sensor, response, E::kF200Coolant);
    return;
  }
  const std::size_t water = maker.add_flow_loop("FIC-200", E::kF200Coolant);
  maker.add_master("PIC-2", "pressure", E::kP2, 50.5, sensor, response, water);
}

}  // namespace

PlantPlan draft_evaporator(std::uint64_t seed) {
  PlanMaker maker(PlantKind::evaporator, 1.0, 10800.0, seed);
  add_supplies(maker);
  add_streams(maker);
  add_feed(maker);
  maker.add_level("LIC-2", Evaporator::kL2, 1.0, 2.0, -1.0 / 20.0 / 60.0, Evaporator::kF2Product,
                  "FIC-2", maker.random().chance(0.3));
  add_vapour(maker);
  add_condenser(maker);
  maker.plan().process = [] { return std::make_unique<Evaporator>(); };
  return maker.take();
}

}  // namespace loopscope::tests::process
