#include "tests/plants/process/causes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/plants/process/stability.hpp"

namespace loopscope::tests::process {
namespace {

using Loops = std::vector<std::size_t>;

template <typename Test>
Loops loops_that(const PlantPlan& plan, Test&& test) {
  Loops found;
  for (std::size_t i = 0; i < plan.loops.size(); ++i)
    if (test(plan.loops[i])) found.push_back(i);
  return found;
}

bool moves_valve(const LoopPlan& loop) {
  return loop.valve.has_value();
}

bool moves_directly(const LoopPlan& loop) {
  return loop.valve && loop.type != "flow";
}

ValvePlan& valve_of(PlantPlan& plan, std::size_t loop) {
  return plan.streams[*plan.loops[loop].valve].valve;
}

std::optional<std::size_t> pick(const Loops& loops, Random& random) {
  if (loops.empty()) return std::nullopt;
  return loops[random.below(loops.size())];
}

/// The friction in % of travel; the slip is four tenths of the stick and more.
void stick(ValvePlan& valve, Random& random) {
  valve.friction = random.chance(0.5) ? Friction::jump : Friction::stribeck;
  valve.stick = random.log_uniform(1.5, 9.0);
  valve.slide = valve.stick * random.uniform(0.0, 0.6);
}

bool put_sticking(Draft& draft, Valves valves, Random& random) {
  draft.source =
      pick(loops_that(draft.with, valves == Valves::any ? moves_valve : moves_directly), random);
  if (!draft.source) return false;
  stick(valve_of(draft.with, *draft.source), random);
  return true;
}

/// Little gain and much integral action: so vessels cycle behind play.
void integrate_more(LoopPlan& loop, Random& random) {
  loop.gain *= random.uniform(0.35, 1.0);
  loop.integral_time_s *= random.uniform(0.25, 1.0);
}

/// Play makes a cycle of its own where a vessel and an integral action meet.
bool put_play(Draft& draft, Random& random) {
  const auto of_vessel = [&draft](const LoopPlan& loop) {
    if (!loop.valve) return false;
    return loop.master ? draft.with.loops[*loop.master].integrating : loop.integrating;
  };
  const Loops loops = loops_that(draft.with, of_vessel);
  const Loops direct = loops_that(draft.with, moves_directly);
  draft.source = pick(random.chance(0.6) ? direct : loops, random);
  if (!draft.source) return false;
  const LoopPlan& loop = draft.with.loops[*draft.source];
  const std::size_t integrating = loop.master.value_or(*draft.source);
  integrate_more(draft.with.loops[integrating], random);
  draft.without.loops[integrating] = draft.with.loops[integrating];
  valve_of(draft.with, *draft.source).friction = Friction::play;
  valve_of(draft.with, *draft.source).play = random.log_uniform(4.0, 18.0);
  return true;
}

bool put_sawtooth(Draft& draft, Random& random) {
  const std::size_t source = random.below(draft.with.loops.size());
  LoopPlan& loop = draft.with.loops[source];
  SawtoothPlan& teeth = loop.sawtooth;
  // Slow enough that the controller follows the drift in part.
  teeth.period_s = random.log_uniform(60.0, 2400.0) * draft.with.step_s;
  teeth.size = 0.01 * (loop.high - loop.low) * random.log_uniform(1.0, 8.0);
  if (random.chance(0.5)) teeth.size = -teeth.size;
  teeth.wander = random.uniform(0.03, 0.2);
  teeth.bend = random.uniform(0.7, 1.4);
  draft.source = source;
  draft.set_period_s = teeth.period_s;
  return true;
}

bool put_wave(Draft& draft, Random& random) {
  UpsetPlan& upset = draft.with.upsets[random.below(draft.with.upsets.size())];
  upset.wave.period_s = random.log_uniform(90.0, 3600.0) * draft.with.step_s;
  upset.wave.amplitude = upset.typical * random.log_uniform(1.0, 5.0);
  upset.wave.wander = random.uniform(0.1, 0.9);
  upset.wave.second = random.chance(0.3) ? random.uniform(0.1, 0.4) : 0.0;
  draft.set_period_s = upset.wave.period_s;
  return true;
}

/// Just below the limit the noise keeps it up; beyond it the output's limits hold it.
bool put_tight(Draft& draft, Random& random) {
  // A flow loop's own swing is over before other loops have felt it.
  const auto slow = [](const LoopPlan& loop) { return loop.type != "flow"; };
  draft.source = random.chance(0.8) ? *pick(loops_that(draft.with, slow), random)
                                    : random.below(draft.with.loops.size());
  LoopPlan& loop = draft.with.loops[*draft.source];
  const Knob knob = random.chance(0.5) ? Knob::gain : Knob::integral_time;
  const std::optional<double> limit = factor_at_limit(draft.with, *draft.source, knob);
  if (!limit) return false;
  const bool beyond = random.chance(0.6);
  loop = tightened(loop, knob,
                   *limit * (beyond ? random.uniform(1.05, 1.5) : random.uniform(0.88, 1.0)));
  if (!beyond) return true;
  const double reach = random.log_uniform(3.0, 20.0);
  loop.op_low = std::max(0.0, loop.op0 - reach * random.uniform(0.7, 1.3));
  loop.op_high = std::min(100.0, loop.op0 + reach);
  return true;
}

bool put(Draft& draft, Cause cause, Valves valves, Random& random) {
  switch (cause) {
    case Cause::sticking_valve:
      return put_sticking(draft, valves, random);
    case Cause::dead_band:
      return put_play(draft, random);
    case Cause::sawtooth_sensor:
      return put_sawtooth(draft, random);
    case Cause::tight_loop:
      return put_tight(draft, random);
    case Cause::outside_wave:
      return put_wave(draft, random);
    case Cause::none:
      break;
  }
  return true;
}

}  // namespace

std::optional<Draft> put_cause(const PlantPlan& plan, Cause cause, Valves valves, Random& random) {
  Draft draft{plan, plan, std::nullopt, std::nullopt};
  if (!put(draft, cause, valves, random)) return std::nullopt;
  return draft;
}

}  // namespace loopscope::tests::process
