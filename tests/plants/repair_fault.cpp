#include "tests/plants/repair_fault.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "tests/effects/loop_frequency.hpp"

namespace loopscope::tests::repairs {
namespace {

using effects::Actuator;
using effects::Draft;
using effects::Friction;
using effects::kFarMoves;
using effects::kQuiet;
using effects::LoopFrequency;
using effects::LoopOptions;
using effects::Moves;
using effects::Random;
using effects::Range;
using effects::Scenario;
using effects::Tuning;

/// Of a loop that travels: its noise has to count beside moves of many percent.
constexpr Range kFlowNoise = {0.3, 1.0};

double on_scale(double low, double high, double size) {
  return low * std::pow(high / low, size);
}

Friction friction_of(double band, double jump_share) {
  return {band * (1.0 + jump_share) / 2.0, band * (1.0 - jump_share) / 2.0};
}

/// S of 1 to 8 %.
PutFault draw_stiction(const Draft& loop, Random& random) {
  const Actuator actuator{random.log_uniform(0.05, 0.3), loop.base.op0};
  const double jump_share = random.uniform(0.2, 1.0);
  const bool karnopp = random.chance(0.5);
  const double response = random.log_uniform(0.03, 0.2);
  return [=](Scenario& scenario, double size) {
    const Friction friction = friction_of(on_scale(1.0, 8.0, size), jump_share);
    scenario.valve = [=] {
      return effects::make_sticking_valve(karnopp, friction, actuator, response);
    };
  };
}

/// Play of 1 to 7 %.
PutFault draw_deadband(const Draft& loop, Random& random) {
  const Actuator actuator{random.log_uniform(0.05, 0.3), loop.base.op0};
  const double response = random.log_uniform(0.03, 0.3);
  return [=](Scenario& scenario, double size) {
    const double width = on_scale(1.0, 7.0, size);
    scenario.valve = [=] { return effects::make_backlash_valve(width, actuator, response); };
  };
}

/// Three to twelve times as much flow for the same travel, worked near the valve's resolution. The
/// controller was set for it.
PutFault draw_oversized(const Draft& loop, Random& random) {
  const Actuator actuator{random.log_uniform(0.05, 0.2), loop.base.op0};
  const Friction resolution = friction_of(random.uniform(0.3, 0.6), random.uniform(0.4, 0.9));
  return [=](Scenario& scenario, double size) {
    const double oversize = on_scale(3.0, 12.0, size);
    scenario.process.gain *= oversize;
    scenario.controller.kc /= oversize;
    scenario.valve = [=] { return effects::make_he_valve(resolution, actuator); };
  };
}

/// An inherent characteristic between 5 : 1 and 60 : 1 where a straight one is due.
PutFault draw_characteristic(const Draft& loop, Random&) {
  const double op0 = loop.base.op0;
  return [=](Scenario& scenario, double size) {
    const double slope = std::log(on_scale(5.0, 60.0, size)) / 100.0;
    scenario.trim = [=](double position) { return std::expm1(slope * (position - op0)) / slope; };
  };
}

/// The gain within 35 to 7 % of the edge of stability.
PutFault draw_tight(const Draft& loop, Random& random) {
  const double faster = random.chance(0.5) ? random.uniform(1.5, 3.0) : 1.0;
  effects::Controller edge = loop.base.controller;
  edge.ti = std::max(1.0, edge.ti / faster);
  edge.kc *= LoopFrequency(loop.base.process).gain_margin(edge);
  return [=](Scenario& scenario, double size) {
    scenario.controller = edge;
    scenario.controller.kc /= 1.0 + on_scale(0.35, 0.07, size);
  };
}

/// A sixth to a fortieth of the gain.
PutFault draw_sluggish(const Draft&, Random& random) {
  const double slower = random.uniform(1.0, 2.0);
  return [=](Scenario& scenario, double size) {
    scenario.controller.kc *= on_scale(0.16, 0.025, size);
    scenario.controller.ti *= slower;
  };
}

/// A sinusoid of one to six standard deviations of the noise joins pv.
PutFault draw_oscillation(const Draft& loop, Random& random) {
  const LoopFrequency response(loop.base.process);
  double frequency = 0.0;
  do {
    frequency = 2.0 * std::numbers::pi / random.log_uniform(15.0, 300.0);
  } while (response.sensitivity(loop.base.controller, frequency) < 0.5);
  const double unit = loop.noise_std;
  return [=](Scenario& scenario, double size) {
    const double amplitude = unit * on_scale(1.0, 6.0, size);
    scenario.output_load = [=](double time) { return amplitude * std::sin(frequency * time); };
  };
}

/// A grid of 0.6 to 4 innovations.
PutFault draw_quantisation(const Draft& loop, Random&) {
  const Scenario& base = loop.base;
  const double unforeseen =
      std::sqrt(effects::predictor(base.load, base.noise_sd * base.noise_sd, 1).variance);
  return [=](Scenario& scenario, double size) {
    scenario.quantum = unforeseen * on_scale(0.6, 4.0, size);
  };
}

/// A value that is renewed every 4 to 20 samples.
PutFault draw_hold(const Draft&, Random&) {
  return [](Scenario& scenario, double size) {
    scenario.hold = static_cast<int>(std::lround(on_scale(4.0, 20.0, size)));
  };
}

constexpr LoopOptions kFirm{.tuning = Tuning::firm, .moves = Moves::none, .noise = kQuiet};
constexpr LoopOptions kMoving{.moves = Moves::small, .noise = kFlowNoise, .reach = kFarMoves};
constexpr LoopOptions kTravelling{.tuning = Tuning::robust,
                                  .moves = Moves::large,
                                  .may_integrate = false,
                                  .load_at_output = true,
                                  .op_range = 35.0,
                                  .most_tau = 30.0,
                                  .noise = kFlowNoise};
constexpr LoopOptions kFlow{.tuning = Tuning::robust,
                            .moves = Moves::none,
                            .may_integrate = false,
                            .most_tau = 8.0,
                            .noise = {0.1, 0.5}};
constexpr LoopOptions kStill{.moves = Moves::none};
/// A loop that is retuned is tuned well.
constexpr LoopOptions kRetuned{.tuning = Tuning::firm, .moves = Moves::none};

}  // namespace

const std::vector<FaultKind>& fault_kinds() {
  static const std::vector<FaultKind> kKinds = {
      {"stiction", "valve", "packing renewed", kFirm, Burden::variance, true, draw_stiction},
      {"deadband", "valve", "linkage and positioner serviced", kMoving, Burden::variance, true,
       draw_deadband},
      {"oversized", "valve", "valve replaced by a smaller one", kFlow, Burden::variance, false,
       draw_oversized},
      {"characteristic", "valve", "seat and plug replaced", kTravelling, Burden::explainable, true,
       draw_characteristic},
      {"tight", "tuning", "controller retuned", kRetuned, Burden::variance, false, draw_tight},
      {"sluggish", "tuning", "controller retuned", kRetuned, Burden::variance, false,
       draw_sluggish},
      {"oscillation",
       "process",
       "pump upstream overhauled",
       {.noise = kQuiet},
       Burden::variance,
       true,
       draw_oscillation},
      {"quantisation", "sensor", "transmitter ranged anew", kStill, Burden::size, false,
       draw_quantisation},
      {"hold", "sensor", "archive set to store every sample", kStill, Burden::size, false,
       draw_hold},
  };
  return kKinds;
}

}  // namespace loopscope::tests::repairs
