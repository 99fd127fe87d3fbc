#include "tests/plants/network/draw_loop.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/effects/load_model.hpp"
#include "tests/generators/simc.hpp"
#include "tests/plants/network/simulate.hpp"

namespace loopscope::tests::network {
namespace {

using effects::Random;

/// Steps of this simulation that the valves of tests/effects call one sample.
constexpr double kValveSample_s = kStep_s * effects::kSubsteps;

Process draw_process(LoopKind kind, Random& random) {
  switch (kind) {
    case LoopKind::flow:
      return {false, random.log_uniform(0.6, 1.6), random.uniform(1.0, 5.0), 0.0,
              random.uniform(0.6, 2.0)};
    case LoopKind::pressure:
      return {false, random.log_uniform(0.5, 2.0), random.log_uniform(8.0, 60.0),
              random.chance(0.4) ? random.uniform(1.0, 6.0) : 0.0, random.uniform(1.0, 5.0)};
    case LoopKind::level:
      return {true, 1.0 / random.log_uniform(100.0, 800.0), 0.0, random.uniform(1.0, 10.0),
              random.uniform(1.0, 4.0)};
    case LoopKind::temperature:
      break;
  }
  const double slow = random.log_uniform(60.0, 400.0);
  return {false, random.log_uniform(0.5, 2.0), slow, slow * random.uniform(0.1, 0.5),
          random.uniform(8.0, 40.0)};
}

double draw_interval(LoopKind kind, Random& random) {
  if (kind == LoopKind::flow) return random.pick({1.0, 1.0, 2.0, 5.0});
  if (kind == LoopKind::pressure) return random.pick({1.0, 2.0, 5.0, 5.0, 10.0});
  if (kind == LoopKind::level) return random.pick({5.0, 10.0, 10.0, 15.0});
  return random.pick({5.0, 10.0, 15.0, 30.0});
}

/// `speed` = closed-loop time constant by the effective delay.
Controller simc(const Process& process, double scan_s, double speed) {
  const double delay = process.delay_s + process.second_time_constant_s / 2.0 + scan_s;
  const double closed = speed * delay + delay;
  if (process.integrating) return {1.0 / (process.gain * closed), 4.0 * closed, scan_s};
  const double slow = process.time_constant_s + process.second_time_constant_s / 2.0;
  const auto [gain, integral_time_s] = generators::simc_of_lag(process.gain, slow, closed);
  return {gain, integral_time_s, scan_s};
}

std::complex<double> open_loop(const LoopPlan& loop, double omega) {
  const Process& process = loop.process;
  const std::complex<double> s(0.0, omega);
  const double delay = process.delay_s + loop.controller.scan_s / 2.0;
  const std::complex<double> controller =
      loop.controller.gain * (1.0 + 1.0 / (s * loop.controller.integral_time_s));
  const std::complex<double> lag = process.integrating ? s : 1.0 + s * process.time_constant_s;
  return controller * process.gain * std::exp(-s * delay) / lag /
         (1.0 + s * process.second_time_constant_s);
}

/// Factor on the gain that brings the loop to the edge of stability.
double gain_margin(const LoopPlan& loop) {
  const double slowest = 2.0 * std::numbers::pi / (400.0 * loop.controller.integral_time_s);
  double last = std::arg(open_loop(loop, slowest));
  for (double omega = slowest; omega < std::numbers::pi / kStep_s; omega *= 1.01) {
    const std::complex<double> now = open_loop(loop, omega);
    if (last < 0.0 && std::arg(now) > 0.0) return 1.0 / std::abs(now);
    last = std::arg(now);
  }
  return 10.0;
}

effects::Actuator draw_actuator(const LoopPlan& loop, Random& random) {
  return {random.log_uniform(0.3, 2.0) / kValveSample_s, loop.op0};
}

void give_play(LoopPlan& loop, double width, Random& random) {
  const effects::Actuator actuator = draw_actuator(loop, random);
  const double response = random.log_uniform(0.2, 1.0) / kValveSample_s;
  loop.valve = [=] { return effects::make_backlash_valve(width, actuator, response); };
}

}  // namespace

LoopPlan draw_loop(LoopKind kind, Random& random) {
  LoopPlan loop;
  loop.kind = kind;
  loop.process = draw_process(kind, random);
  const double sign = random.chance(0.2) ? -1.0 : 1.0;
  loop.process.gain *= sign;
  loop.interval_s = draw_interval(kind, random);
  loop.end_early_s = loop.interval_s * random.whole(0, 40);
  const double scan_s = random.chance(0.5) && loop.interval_s <= 5.0 ? loop.interval_s : 1.0;
  const double speed =
      kind == LoopKind::level ? random.log_uniform(3.0, 15.0) : random.log_uniform(0.8, 2.5);
  loop.controller = simc(loop.process, scan_s, speed);
  loop.op0 = random.uniform(35.0, 65.0);
  loop.noise_sd = random.log_uniform(0.05, 0.3);
  loop.load_sd = random.log_uniform(0.1, 0.8);
  loop.load_tau_s = random.log_uniform(20.0, 1000.0);
  if (random.chance(0.15)) loop.quantum = random.uniform(0.05, 0.2);
  if (random.chance(0.1)) {
    loop.sp_moves_s = random.log_uniform(0.05, 0.3) * loop.interval_s * kSamples;
    loop.sp_size = random.uniform(1.0, 4.0);
  }
  if (random.chance(0.6)) give_play(loop, random.log_uniform(0.05, 0.4), random);
  return loop;
}

void make_stick(LoopPlan& loop, Random& random) {
  if (loop.process.integrating && random.chance(0.2)) {
    give_play(loop, random.log_uniform(2.0, 6.0), random);
    return;
  }
  const double band = random.log_uniform(2.5, 12.0);
  const double jump = band * random.uniform(0.15, 1.0);
  const effects::Friction friction = generators::friction_of(band, jump);
  const effects::Actuator actuator = draw_actuator(loop, random);
  const double response = random.log_uniform(0.1, 1.0) / kValveSample_s;
  const bool karnopp = random.chance(0.5);
  loop.valve = [=] { return effects::make_sticking_valve(karnopp, friction, actuator, response); };
}

void make_tight(LoopPlan& loop, Random& random) {
  if (random.chance(0.5)) loop.controller.integral_time_s /= random.uniform(1.5, 3.0);
  loop.controller.gain *= gain_margin(loop) / random.uniform(1.15, 1.5);
}

}  // namespace loopscope::tests::network
