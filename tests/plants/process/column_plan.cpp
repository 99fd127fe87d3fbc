#include "tests/plants/process/column.hpp"
#include "tests/plants/process/plan_maker.hpp"

namespace loopscope::tests::process {
namespace {

using C = Column;

void add_column_supplies(PlanMaker& maker) {
  maker.add_upset(0.1, 60.0, 2000.0);   // inflow, lb/min
  maker.add_upset(1.5, 300.0, 5000.0);  // methanol in the feed, weight %
  maker.add_upset(1.0, 100.0, 4000.0);  // coolant, K
  maker.add_upset(0.03, 20.0, 600.0);   // steam header, by the flow
  maker.add_upset(0.04, 20.0, 600.0);   // water header
  maker.add_upset(0.01, 20.0, 300.0);   // feed head
}

void add_column_streams(PlanMaker& maker) {
  maker.add_stream(C::kFeedFlow, 2.0, C::kFeedHead);
  maker.add_stream(C::kRefluxFlow, 1.5, std::nullopt);
  maker.add_stream(C::kSteamFlow, 2.5, C::kSteamHeader);
  maker.add_stream(C::kDistillateFlow, 1.5, std::nullopt);
  maker.add_stream(C::kBottomsFlow, 1.5, std::nullopt);
  maker.add_stream(C::kCoolantFlow, 3.0, C::kWaterHeader);
}

/// Of a vessel in %: by a second and lb/min.
double level_gain(double full) {
  return -100.0 / full / 60.0;
}

/// The feed's flow loop.
std::size_t add_column_feed(PlanMaker& maker) {
  if (maker.random().chance(0.4)) return maker.add_flow_loop("FIC-10", C::kFeed);
  return maker.add_level("LIC-10", C::kFeedTank, 50.0, 100.0, level_gain(C::kTankFull), C::kFeed,
                         "FIC-10", false) -
         1;
}

/// How the top is held: the level by distillate and the content by reflux, or crosswise.
struct TopStreams {
  std::size_t content, level;
  std::string content_flow, level_flow;
  double content_gain;
};

TopStreams draw_top(Random& random) {
  if (random.chance(0.6)) return {C::kReflux, C::kDistillate, "FIC-11", "FIC-14", 18.0};
  return {C::kDistillate, C::kReflux, "FIC-14", "FIC-11", -18.0};
}

/// Both ends on composition, or the bottom alone with the top's stream in a ratio to the feed. Each
/// is tuned as if its gain were higher and its path longer: the other one interferes.
void add_contents(PlanMaker& maker, std::size_t feed, const TopStreams& streams) {
  const Sensor top{.low = 92.0, .high = 100.0, .lag_s = 10.0, .noise = 0.25, .scan_steps = 5};
  const Sensor bottom{.low = 0.0, .high = 4.0, .lag_s = 10.0, .noise = 0.25, .scan_steps = 5};
  const std::size_t flow = maker.add_flow_loop(streams.content_flow, streams.content);
  if (maker.random().chance(0.7)) {
    maker.add_master("AIC-11", "composition", C::kTop, C::kTop0, top,
                     {.gain = streams.content_gain, .time_constant_s = 1002.0, .late_s = 150.0},
                     flow);
  } else {
    maker.set_ratio(flow, feed);
  }
  const std::size_t steam = maker.add_flow_loop("FIC-12", C::kSteam);
  maker.add_master("AIC-12", "composition", C::kBottom, C::kBottom0, bottom,
                   {.gain = -27.0, .time_constant_s = 864.0, .late_s = 250.0}, steam);
}

void add_pressure(PlanMaker& maker) {
  const Sensor sensor{.low = 12.0, .high = 18.0, .lag_s = 2.0, .noise = 0.15};
  const Response response{.gain = -0.041, .time_constant_s = 40.0, .late_s = 8.0};
  if (maker.random().chance(0.6)) {
    maker.add_loop("PIC-13", "pressure", C::kPressure, C::kPressure0, sensor, response,
                   C::kCoolant);
    return;
  }
  const std::size_t water = maker.add_flow_loop("FIC-13", C::kCoolant);
  maker.add_master("PIC-13", "pressure", C::kPressure, C::kPressure0, sensor, response, water);
}

}  // namespace

PlantPlan draft_column(std::uint64_t seed) {
  PlanMaker maker(PlantKind::column, 1.0, 10800.0, seed);
  add_column_supplies(maker);
  add_column_streams(maker);
  const std::size_t feed = add_column_feed(maker);
  const TopStreams top = draw_top(maker.random());
  add_contents(maker, feed, top);
  add_pressure(maker);
  maker.add_level("LIC-14", C::kDrum, 50.0, 100.0, level_gain(C::kDrumFull), top.level,
                  top.level_flow, maker.random().chance(0.4));
  maker.add_level("LIC-15", C::kBase, 50.0, 100.0, level_gain(C::kBaseFull), C::kBottoms, "FIC-15",
                  maker.random().chance(0.4));
  const double step_s = maker.plan().step_s;
  maker.plan().process = [step_s] { return std::make_unique<Column>(step_s); };
  return maker.take();
}

}  // namespace loopscope::tests::process
