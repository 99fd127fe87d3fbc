#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/loop/shape.hpp"
#include "tests/core/loop/signals.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;
using signals::SimulatedLoop;
using signals::Wave;

constexpr int kSeeds = 400;
constexpr int kShapeSeeds = 100;

/// Median of what was measured; "-" when nothing was.
std::string median(std::vector<double> values) {
  if (values.empty()) return "-";
  std::sort(values.begin(), values.end());
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", values[values.size() / 2]);
  return text;
}

void keep(std::vector<double>& values, const std::optional<double>& value) {
  if (value) values.push_back(*value);
}

void print_rate(const char* name, std::size_t count, const std::function<Series(Random&)>& draw) {
  int present = 0;
  std::vector<double> period, regularity, amplitude, persistence;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Oscillation result = find_oscillation(draw(random), 1.0);
    present += result.present ? 1 : 0;
    keep(period, result.period_s);
    keep(regularity, result.regularity);
    keep(amplitude, result.amplitude);
    keep(persistence, result.persistence);
  }
  std::printf("| %s | %zu | %.1f %% | %s | %s | %s | %s |\n", name, count, 100.0 * present / kSeeds,
              median(period).c_str(), median(regularity).c_str(), median(amplitude).c_str(),
              median(persistence).c_str());
}

void print_noise_rates(std::size_t count) {
  print_rate("white noise", count, [=](Random& r) { return signals::white(r, count); });
  print_rate("AR(1) 0.9", count, [=](Random& r) { return signals::ar1(r, count, 0.9); });
  print_rate("AR(1) 0.99", count, [=](Random& r) { return signals::ar1(r, count, 0.99); });
  print_rate("random walk", count, [=](Random& r) { return signals::ar1(r, count, 1.0); });
  print_rate("random walk, 30 % missing", count,
             [=](Random& r) { return signals::with_missing(r, signals::ar1(r, count, 1.0), 0.3); });
  for (const double damping : {0.97, 0.9, 0.8}) {
    const std::string name = "resonance, period 20, poles " + median({damping});
    print_rate(name.c_str(), count,
               [=](Random& r) { return signals::resonance(r, count, 20.0, damping); });
  }
}

void print_wave_rates(std::size_t count) {
  const auto noisy = [=](Random& r, Wave kind, double period, double jitter, double snr_db) {
    const Series clean = signals::wave(r, count, kind, period, jitter);
    return signals::at_snr(clean, signals::white(r, count), snr_db);
  };
  for (const double period : {20.0, 100.0, 300.0}) {
    if (period * 5.0 > static_cast<double>(count)) continue;
    for (const double snr_db : {0.0, 10.0}) {
      const std::string name = "sinusoid, period " + std::to_string(static_cast<int>(period)) +
                               ", " + std::to_string(static_cast<int>(snr_db)) + " dB";
      print_rate(name.c_str(), count,
                 [=](Random& r) { return noisy(r, Wave::sine, period, 0.0, snr_db); });
    }
  }
  print_rate("square, period 100, jitter 0.2, 10 dB", count,
             [=](Random& r) { return noisy(r, Wave::square, 100.0, 0.2, 10.0); });
  print_rate("triangle, period 100, jitter 0.2, 10 dB", count,
             [=](Random& r) { return noisy(r, Wave::triangle, 100.0, 0.2, 10.0); });
  print_rate("sinusoid, period 20, 0 dB, 30 % missing", count, [=](Random& r) {
    return signals::with_missing(r, noisy(r, Wave::sine, 20.0, 0.0, 0.0), 0.3);
  });
  for (const double drift : {0.1, 0.2}) {
    const std::string name = "sinusoid, period 100, 10 dB, on a walk with steps " + median({drift});
    print_rate(name.c_str(), count, [=](Random& r) {
      return signals::sum(noisy(r, Wave::sine, 100.0, 0.0, 10.0), signals::ar1(r, count, 1.0),
                          drift);
    });
  }
}

LOOPSCOPE_TABLE(loop_oscillation, "records called oscillating, and what was measured") {
  std::puts("| signal | samples | present | period | regularity | amplitude | persistence |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const std::size_t count : {std::size_t{4096}, std::size_t{751}}) {
    print_noise_rates(count);
    print_wave_rates(count);
  }
}

void print_shape(const char* name, const std::function<SimulatedLoop(Random&)>& draw) {
  int present = 0;
  std::vector<double> dtau, drho, index, ellipse, r2, width, stuck;
  for (int seed = 1; seed <= kShapeSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const SimulatedLoop loop = draw(random);
    const Oscillation oscillation = find_oscillation(loop.pv, 1.0);
    present += oscillation.present ? 1 : 0;
    const auto period = oscillation.present ? oscillation.period_s : std::nullopt;
    const Shape shape = measure_shape({{}, loop.pv, loop.op, loop.mv, period, false});
    keep(dtau, shape.horch_dtau);
    keep(drho, shape.horch_drho);
    keep(index, shape.shape_index);
    keep(ellipse, shape.ellipse_stiction);
    keep(r2, shape.ellipse_r2);
    keep(width, shape.mv_op_width);
    keep(stuck, shape.mv_stuck_fraction);
  }
  std::printf("| %s | %d %% | %s | %s | %s | %s | %s | %s | %s |\n", name,
              100 * present / kShapeSeeds, median(dtau).c_str(), median(drho).c_str(),
              median(index).c_str(), median(ellipse).c_str(), median(r2).c_str(),
              median(width).c_str(), median(stuck).c_str());
}

LOOPSCOPE_TABLE(loop_shape, "shape indicators of simulated loops") {
  std::puts("| loop | present | dtau | drho | shape index | ellipse | r2 | mv-op width | stuck |");
  std::puts("|---|---|---|---|---|---|---|---|---|");
  const auto simulated = [](const char* name, const signals::LoopSettings& settings) {
    print_shape(name, [=](Random& r) { return signals::simulate(r, 4096, settings); });
  };
  simulated("well tuned (5.1)", {.walk_std = 0.224});
  simulated("outside sinusoid (5.3)", {.sinusoid_amplitude = 2.0, .walk_std = 0.224});
  simulated("integral action x 2.5", {.integral = 0.375, .walk_std = 0.224});
  simulated("S 3, J 1, quiet load",
            {.stickband = 3.0, .slip_jump = 1.0, .walk_std = 0.05, .setpoint_step = 10.0});
  simulated("S 3, J 1 (5.4)",
            {.stickband = 3.0, .slip_jump = 1.0, .walk_std = 0.224, .setpoint_step = 10.0});
  simulated("dead band 3", {.stickband = 3.0, .walk_std = 0.224, .setpoint_step = 10.0});
}

LOOPSCOPE_TABLE(loop_shape_index_in_noise, "shape index by wave and noise") {
  std::puts("| wave | period | 0 dB | 10 dB | 20 dB | 60 dB |");
  std::puts("|---|---|---|---|---|---|");
  for (const auto& [name, kind] : {std::pair{"sine", Wave::sine}, std::pair{"square", Wave::square},
                                   std::pair{"triangle", Wave::triangle}}) {
    for (const double period : {20.0, 100.0, 300.0}) {
      std::printf("| %s | %.0f |", name, period);
      for (const double snr_db : {0.0, 10.0, 20.0, 60.0}) {
        std::vector<double> index;
        for (int seed = 1; seed <= kShapeSeeds; ++seed) {
          Random random(static_cast<std::uint64_t>(seed));
          const Series op = signals::at_snr(signals::wave(random, 4096, kind, period, 0.03),
                                            signals::white(random, 4096), snr_db);
          keep(index, measure_shape({{}, op, op, {}, period, false}).shape_index);
        }
        std::printf(" %s |", median(index).c_str());
      }
      std::puts("");
    }
  }
}

/// Best of many runs, microseconds: what the work costs when nothing else disturbs it.
double best_us(const std::function<void()>& work) {
  double best = 1e9;
  for (int run = 0; run < 200; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  return best;
}

LOOPSCOPE_TABLE(loop_speed, "microseconds of a window of 4096") {
  Random random(1);
  const SimulatedLoop whole = signals::simulate(
      random, 4096, {.stickband = 3.0, .slip_jump = 1.0, .walk_std = 0.1, .setpoint_step = 10.0});
  SimulatedLoop with_gap = whole;
  std::fill_n(with_gap.pv.begin() + 500, 100, std::nan(""));
  std::puts("| one window of 4096 | oscillation | performance | shape with mv |");
  std::puts("|---|---|---|---|");
  for (const auto& named : {std::pair{"complete", &whole},
                            std::pair{"100 samples missing", &std::as_const(with_gap)}}) {
    const SimulatedLoop* const loop = named.second;
    const double oscillation = best_us([&] { (void)find_oscillation(loop->pv, 1.0); });
    const double performance =
        best_us([&] { (void)measure_performance(loop->pv, loop->op, {}, 1.0); });
    const double shape = best_us([&] {
      (void)measure_shape({{}, loop->pv, loop->op, loop->mv, 47.0, false});
    });
    std::printf("| %s | %.0f us | %.0f us | %.0f us |\n", named.first, oscillation, performance,
                shape);
  }
}

}  // namespace
}  // namespace loopscope::core::loop
