#include "tests/plants/paper_repairs.hpp"

#include <cmath>
#include <memory>

#include "tests/effects/valve.hpp"

namespace loopscope::tests::repairs {
namespace {

using effects::Actuator;
using effects::Friction;
using effects::Scenario;

constexpr double kMinute = 60.0;

/// A flow loop of a fast process under PI control; pv rises from 50 % of span.
Scenario flow_loop(double load_step) {
  Scenario loop;
  loop.process = {.gain = 1.2, .tau = 3.0, .delay = 1.2};
  loop.controller = {.kc = 0.7, .ti = 4.0};
  loop.load = effects::output_load_model(0.99);
  loop.load.scale = load_step;
  loop.noise_sd = 0.15;
  loop.sp.assign(effects::kRunIn + effects::kSamples, 0.0);
  return loop;
}

void stick(Scenario& loop, Friction friction) {
  const Actuator actuator{.lag = 0.1, .start = loop.op0};
  loop.valve = [=] { return effects::make_he_valve(friction, actuator); };
}

/// Two straight pieces that meet at the working point.
effects::Curve bent(double below, double above) {
  return [=](double flow) { return flow * (flow < 0.0 ? below : above); };
}

/// The pressure in front of the valve wanders: it reaches pv through whatever the seat does to it.
effects::TimeFunction pressure(double deviation, effects::Random& random) {
  constexpr double kMemory = 0.8;
  auto values = std::make_shared<std::vector<double>>(effects::kRunIn + effects::kSamples + 1);
  double value = 0.0;
  for (double& now : *values)
    now = value =
        kMemory * value + deviation * std::sqrt(1.0 - kMemory * kMemory) * random.normal();
  return [values](double time) {
    return (*values)[static_cast<std::size_t>(time + static_cast<double>(effects::kRunIn))];
  };
}

/// `swing` = standard deviation of the pressure's share in the flow, %.
struct State {
  Scenario loop;
  double swing = 0.0;
};

std::vector<effects::Series> run(const State& state, std::size_t windows, effects::Random& random) {
  Scenario loop = state.loop;
  std::vector<effects::Series> series;
  for (std::size_t i = 0; i < windows; ++i) {
    loop.noise_seed = random.next();
    if (state.swing > 0.0) loop.input_load = pressure(state.swing, random);
    series.push_back(effects::simulate(loop));
    for (double& value : series.back().sp) value += loop.pv0;
    for (double& value : series.back().pv) value += loop.pv0;
  }
  return series;
}

Repair repaired(const char* work, Word word, const State& before, const State& after,
                std::size_t windows, std::uint64_t seed) {
  effects::Random random(effects::seed_for(work, seed));
  Repair repair;
  repair.fault = "paper";
  repair.word = word;
  repair.event_kind = "valve";
  repair.work = work;
  repair.interval_s = kMinute;
  repair.before = run(before, windows, random);
  repair.after = run(after, windows, random);
  return repair;
}

}  // namespace

Repair flow_loop_1(std::size_t windows, std::uint64_t seed) {
  constexpr double kOversize = 10.0;
  const Scenario after = flow_loop(0.06);
  Scenario before = after;
  before.process.gain *= kOversize;
  before.controller.kc /= kOversize;
  stick(before, {.static_friction = 0.35, .kinetic_friction = 0.1});
  return repaired("6 inch valve replaced by a 3 inch valve", Word::fixed, {before}, {after},
                  windows, seed);
}

Repair flow_loop_2(std::size_t windows, std::uint64_t seed) {
  constexpr double kSwing = 3.0;
  Scenario before = flow_loop(0.06);
  Scenario after = before;
  before.process.output_curve = bent(0.7, 1.8);
  stick(before, {.static_friction = 2.0, .kinetic_friction = 1.0});
  after.process.output_curve = bent(0.7, 1.1);
  return repaired("corroded seat and plug replaced", Word::improved, {before, kSwing},
                  {after, kSwing}, windows, seed);
}

}  // namespace loopscope::tests::repairs
