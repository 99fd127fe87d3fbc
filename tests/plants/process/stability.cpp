#include "tests/plants/process/stability.hpp"

#include <algorithm>
#include <cmath>

#include "tests/plants/process/simulate.hpp"
#include "tests/plants/process/spectrum.hpp"

namespace loopscope::tests::process {
namespace {

/// The sensor jumps up once, by half a percent of its span, and down again much later.
void nudge(LoopPlan& loop) {
  loop.sawtooth = {.size = 0.005 * (loop.high - loop.low), .period_s = 1e9, .wander = 0.0};
}

PlantPlan quiet_copy(const PlantPlan& plan, std::size_t nudged) {
  PlantPlan quiet = plan;
  quiet.settle_s = 0.0;
  for (UpsetPlan& upset : quiet.upsets) upset.sd = 0.0;
  for (StreamPlan& stream : quiet.streams) stream.valve.play = 0.0;
  for (LoopPlan& loop : quiet.loops) {
    loop.noise_sd = loop.quantum = loop.sp_moves_s = 0.0;
    loop.op_low = 0.0;
    loop.op_high = 100.0;
  }
  nudge(quiet.loops[nudged]);
  return quiet;
}

/// Long enough for some swings of this loop.
Window trial_window(const PlantPlan& plan, const LoopPlan& loop) {
  const double length_s =
      std::clamp(10.0 * loop.integral_time_s, 400.0 * plan.step_s, 8000.0 * plan.step_s);
  return {.samples = static_cast<std::size_t>(length_s / plan.step_s)};
}

bool swings_up(const PlantPlan& quiet, std::size_t loop, Window window) {
  const std::vector<Record> records = simulate(quiet, window);
  if (records.empty()) return true;
  const std::vector<double>& op = records[loop].op;
  const auto quarter = static_cast<std::ptrdiff_t>(op.size() / 4);
  const double third = variance({op.end() - 2 * quarter, op.end() - quarter});
  const double last = variance({op.end() - quarter, op.end()});
  return last > 1e-7 && last > third;
}

}  // namespace

LoopPlan tightened(LoopPlan loop, Knob knob, double factor) {
  if (knob == Knob::gain) loop.gain *= factor;
  if (knob == Knob::integral_time) loop.integral_time_s /= factor;
  return loop;
}

std::optional<double> factor_at_limit(const PlantPlan& plan, std::size_t loop, Knob knob) {
  PlantPlan quiet = quiet_copy(plan, loop);
  const LoopPlan drawn = quiet.loops[loop];
  const Window window = trial_window(plan, plan.loops[loop]);
  const auto swings_at = [&](double factor) {
    quiet.loops[loop] = tightened(drawn, knob, factor);
    return swings_up(quiet, loop, window);
  };
  double low = 1.0, high = 2.0;
  if (swings_at(low)) return std::nullopt;
  while (!swings_at(high)) {
    low = high;
    high *= 2.0;
    if (high > 64.0) return std::nullopt;
  }
  for (int halving = 0; halving < 5; ++halving) {
    const double middle = std::sqrt(low * high);
    (swings_at(middle) ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace loopscope::tests::process
