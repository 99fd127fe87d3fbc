#include "tests/plants/process/four_tanks.hpp"
#include "tests/plants/process/plan_maker.hpp"

namespace loopscope::tests::process {
namespace {

using F = FourTanks;

void add_tank_supplies(PlanMaker& maker) {
  maker.add_upset(0.02, 10.0, 300.0);  // pump power, by the flow
  maker.add_upset(0.05, 10.0, 300.0);  // town head
  maker.add_upset(0.3, 20.0, 400.0);   // drawn from the upper tanks, cm^3/s
  maker.add_upset(0.3, 20.0, 400.0);
  maker.add_upset(0.04, 10.0, 300.0);  // bleed head
  maker.add_upset(0.3, 20.0, 400.0);   // into the first sump, cm^3/s
}

void add_tank_streams(PlanMaker& maker, const F::Setting& setting) {
  maker.add_stream(setting.flow_1, 0.5, F::kPumpPower);
  maker.add_stream(setting.flow_2, 0.5, F::kPumpPower);
  maker.add_stream(F::kBleedFlow, 0.8, F::kTownHead);
  maker.add_stream(setting.transfer(), 0.6, std::nullopt);
  maker.add_stream(F::kBleedFlow, 0.6, F::kBleedHead);
}

/// A lower tank from the pump that does most to it: by its own split, or by way of the upper tank.
Response response_of(const F::Setting& setting, bool first) {
  if (!setting.crossed()) {
    return first ? Response{.gain = 1.567, .time_constant_s = 62.0, .late_s = 6.0}
                 : Response{.gain = 1.69, .time_constant_s = 90.0, .late_s = 6.0};
  }
  return first ? Response{.gain = 1.49, .time_constant_s = 83.0, .late_s = 45.0}
               : Response{.gain = 1.63, .time_constant_s = 119.0, .late_s = 60.0};
}

/// On its pump, or on the flow behind that.
void add_lower_tank(PlanMaker& maker, const F::Setting& setting, bool first, bool direct) {
  const Sensor sensor{.high = 25.0, .lag_s = 0.5, .noise = 0.2, .scan_steps = 2};
  const Response response = response_of(setting, first);
  const std::string name = first ? "LIC-1" : "LIC-2";
  const std::size_t value = first ? F::kLevel1 : F::kLevel2;
  const std::size_t pump = first == setting.crossed() ? F::kPump2 : F::kPump1;
  const double nominal = setting.levels[first ? 0 : 1];
  if (direct) {
    maker.add_loop(name, "level", value, nominal, sensor, response, pump);
    return;
  }
  const std::size_t flow = maker.add_flow_loop(pump == F::kPump1 ? "FIC-1" : "FIC-2", pump);
  maker.add_master(name, "level", value, nominal, sensor, response, flow);
}

}  // namespace

PlantPlan draft_four_tanks(std::uint64_t seed) {
  PlanMaker maker(PlantKind::four_tanks, 0.25, 1500.0, seed);
  const F::Setting setting = maker.random().chance(0.6) ? F::kMinimumPhase : F::kNonminimumPhase;
  const double shared_suction = maker.random().uniform(0.1, 0.35);
  add_tank_supplies(maker);
  add_tank_streams(maker, setting);
  const bool on_pump = maker.random().chance(0.35);
  add_lower_tank(maker, setting, false, on_pump);
  add_lower_tank(maker, setting, true, maker.random().chance(0.4));
  const double gain = 1.0 / F::kSumpArea;
  maker.add_level("LIC-5", F::kSump1, F::kSumpLevel, 40.0, gain, F::kMakeup, "FIC-5",
                  !on_pump && maker.random().chance(0.6));
  maker.add_level("LIC-6", F::kSump2, F::kSumpLevel, 40.0, gain, F::kTransfer, "FIC-6",
                  maker.random().chance(0.45));
  const std::size_t bleed = maker.add_flow_loop("FIC-7", F::kBleed);
  // The first loop is the flow of a pump.
  if (!on_pump && maker.random().chance(0.8)) maker.set_ratio(bleed, 0);
  maker.plan().process = [setting, shared_suction] {
    return std::make_unique<FourTanks>(setting, shared_suction);
  };
  return maker.take();
}

}  // namespace loopscope::tests::process
