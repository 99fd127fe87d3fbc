#include "tests/plants/process/plan_maker.hpp"
#include "tests/plants/process/reactor_recycle.hpp"

namespace loopscope::tests::process {
namespace {

using R = ReactorRecycle;

constexpr double kAnHour_s = 3600.0;

void add_reactor_supplies(PlanMaker& maker) {
  maker.add_upset(0.02, 20.0, 600.0);      // feed head, by the flow
  maker.add_upset(0.01, 300.0, 6000.0);    // A in the feed
  maker.add_upset(4.0, 200.0, 5000.0);     // feed, F
  maker.add_upset(2.0, 200.0, 5000.0);     // water, F
  maker.add_upset(0.02, 1000.0, 10000.0);  // catalyst
  maker.add_upset(0.02, 20.0, 600.0);      // steam header
  maker.add_upset(0.04, 20.0, 600.0);      // water header
}

void add_reactor_streams(PlanMaker& maker) {
  maker.add_stream(R::kFreshFlow, 2.0, R::kFeedHead);
  maker.add_stream(R::kEffluentFlow, 2.0, std::nullopt);
  maker.add_stream(R::kRecycleFlow, 2.0, std::nullopt);
  maker.add_stream(R::kBottomsFlow, 2.0, std::nullopt);
  maker.add_stream(R::kSteamFlow, 3.0, R::kSteamHeader);
  maker.add_stream(R::kRefluxFlow, 2.0, std::nullopt);
  maker.add_stream(R::kJacketFlow, 3.0, R::kWaterHeader);
  maker.add_stream(R::kCondenserFlow, 3.0, R::kWaterHeader);
}

/// Of a vessel in %, at 50 % with `hold` lbmol: by a second and lbmol/h.
double vessel_gain(double hold) {
  return 50.0 / hold / kAnHour_s;
}

/// The fresh feed set and the level by the effluent, or one flow of the recycle set and the fresh
/// feed by the level, which Luyben recommends. Answers the effluent's flow loop.
std::size_t add_reactor_level(PlanMaker& maker, double size) {
  const double gain = vessel_gain(size * R::kReactorHold);
  if (maker.random().chance(0.5)) {
    maker.add_flow_loop("FIC-101", R::kFresh);
    return maker.add_level("LIC-103", R::kReactorLevel, 50.0, 100.0, -gain, R::kEffluent, "FIC-103",
                           false) -
           1;
  }
  maker.add_level("LIC-103", R::kReactorLevel, 50.0, 100.0, gain, R::kFresh, "FIC-101",
                  maker.random().chance(0.3));
  return maker.add_flow_loop("FIC-103", R::kEffluent);
}

/// Temperature on the jacket's, and that on the water's valve or flow.
void add_temperatures(PlanMaker& maker, double size) {
  const Sensor jacket{.low = 60.0, .high = 130.0, .lag_s = 8.0, .noise = 0.1};
  const Sensor reactor{.low = 110.0, .high = 170.0, .lag_s = 20.0, .noise = 0.08, .scan_steps = 2};
  const Response of_water{.gain = -1.5e-4, .time_constant_s = 64.0, .late_s = 12.0};
  std::size_t below = 0;
  if (maker.random().chance(0.3)) {
    const std::size_t water = maker.add_flow_loop("FIC-102", R::kJacketWater);
    below = maker.add_master("TIC-102", "temperature", R::kJacket, R::kJacket0, jacket, of_water,
                             water);
  } else {
    below = maker.add_loop("TIC-102", "temperature", R::kJacket, R::kJacket0, jacket, of_water,
                           R::kJacketWater);
  }
  maker.add_master("TIC-101", "temperature", R::kTemperature, R::kTemperature0, reactor,
                   {.gain = 2.0, .time_constant_s = 9600.0 * size, .late_s = 80.0}, below);
}

void add_separator(PlanMaker& maker, std::size_t effluent) {
  maker.add_level("LIC-104", R::kDrum, 50.0, 100.0, -vessel_gain(R::kDrumHold), R::kRecycle,
                  "FIC-104", maker.random().chance(0.3));
  maker.add_level("LIC-105", R::kBase, 50.0, 100.0, -vessel_gain(R::kBaseHold), R::kBottoms,
                  "FIC-105", maker.random().chance(0.6));
  const std::size_t steam = maker.add_flow_loop("FIC-106", R::kSteam);
  maker.add_master("TIC-106", "temperature", R::kTray, R::kTray0,
                   {.low = 140.0, .high = 240.0, .lag_s = 15.0, .noise = 0.1, .scan_steps = 2},
                   {.gain = 0.025, .time_constant_s = 220.0, .late_s = 40.0}, steam);
  maker.add_loop("PIC-107", "pressure", R::kPressure, R::kPressure0,
                 {.low = 15.0, .high = 35.0, .lag_s = 2.0, .noise = 0.12},
                 {.gain = -0.00125, .time_constant_s = 67.0, .late_s = 8.0}, R::kCondenserWater);
  const std::size_t reflux = maker.add_flow_loop("FIC-108", R::kReflux);
  if (maker.random().chance(0.6)) maker.set_ratio(reflux, effluent);
}

}  // namespace

PlantPlan draft_reactor_recycle(std::uint64_t seed) {
  PlanMaker maker(PlantKind::reactor_recycle, 1.0, 14400.0, seed);
  const double size = maker.random().log_uniform(0.08, 0.25);
  add_reactor_supplies(maker);
  add_reactor_streams(maker);
  const std::size_t effluent = add_reactor_level(maker, size);
  add_temperatures(maker, size);
  add_separator(maker, effluent);
  maker.plan().process = [size] { return std::make_unique<ReactorRecycle>(size); };
  return maker.take();
}

}  // namespace loopscope::tests::process
