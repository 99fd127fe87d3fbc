#include "tests/plants/network/draw_plan.hpp"

#include <algorithm>
#include <string>

#include "tests/plants/network/draw_loop.hpp"
#include "tests/plants/network/draw_streams.hpp"

namespace loopscope::tests::network {
namespace {

using effects::Random;

std::size_t add(PlantPlan& plan, LoopKind kind, const std::string& name, std::size_t unit,
                Random& random) {
  plan.loops.push_back(draw_loop(kind, random));
  plan.loops.back().name = name;
  plan.loops.back().unit = unit;
  return plan.loops.size() - 1;
}

Unit add_unit(PlantPlan& plan, std::size_t number, Random& random) {
  const auto named = [&](const char* letters, int place) {
    return std::to_string(number) + letters + "0" + std::to_string(place);
  };
  Unit unit;
  unit.feed = add(plan, LoopKind::flow, named("FC", 1), number, random);
  unit.level = add(plan, LoopKind::level, named("LC", 2), number, random);
  unit.outflow = add(plan, LoopKind::flow, named("FC", 3), number, random);
  unit.temperature = add(plan, LoopKind::temperature, named("TC", 4), number, random);
  unit.steam = add(plan, LoopKind::flow, named("FC", 5), number, random);
  unit.pressure = add(plan, LoopKind::pressure, named("PC", 6), number, random);
  unit.reflux = add(plan, random.chance(0.6) ? LoopKind::flow : LoopKind::temperature,
                    named("XC", 7), number, random);
  return unit;
}

/// The slave's span is the master's: op of the master asks for as much flow, in %.
void couple(PlantPlan& plan, std::size_t master, std::size_t slave, Random& random) {
  LoopPlan& slow = plan.loops[master];
  LoopPlan& fast = plan.loops[slave];
  fast.master = master;
  fast.master_gain = random.uniform(0.6, 1.2);
  fast.sp_moves_s = 0.0;
  slow.valve = {};
  slow.op0 = 50.0;
  slow.process.gain /= fast.master_gain;
}

void add_cascades(PlantPlan& plan, const std::vector<Unit>& units, Random& random) {
  int pairs = 0;
  for (const Unit& unit : units) {
    if (random.chance(0.35)) couple(plan, unit.temperature, unit.steam, random), ++pairs;
    if (random.chance(0.25)) couple(plan, unit.level, unit.outflow, random), ++pairs;
  }
  if (pairs == 0) couple(plan, units[1].temperature, units[1].steam, random);
}

bool is_master(const PlantPlan& plan, std::size_t loop) {
  return std::ranges::any_of(plan.loops, [loop](const LoopPlan& l) { return l.master == loop; });
}

/// A loop of this kind that moves a valve; of the last unit for a recycle.
std::optional<std::size_t> draw_source(const PlantPlan& plan, Origin origin, LoopKind kind,
                                       Random& random) {
  std::vector<std::size_t> loops;
  const std::size_t last = plan.loops.back().unit;
  for (std::size_t i = 0; i < plan.loops.size(); ++i) {
    const LoopPlan& loop = plan.loops[i];
    if (loop.kind != kind || is_master(plan, i)) continue;
    if (origin != Origin::recycle || loop.unit == last) loops.push_back(i);
  }
  if (loops.empty()) return std::nullopt;
  return loops[static_cast<std::size_t>(random.whole(0, static_cast<int>(loops.size()) - 1))];
}

void draw_outside(PlantPlan& plan, const std::vector<Unit>& units, Random& random) {
  Outside& outside = plan.outside;
  outside.period_s = random.log_uniform(50.0, 1500.0);
  outside.amplitude = random.log_uniform(1.5, 5.0);
  outside.wander = random.chance(0.5) ? 0.0 : random.log_uniform(0.05, 0.4);
  outside.third = random.chance(0.3) ? random.uniform(0.05, 0.2) : 0.0;
  outside.loops = {0, 1};
  for (const Unit& unit : units)
    for (const std::size_t loop : {unit.level, unit.temperature, unit.pressure, unit.steam})
      if (random.chance(0.4)) outside.loops.push_back(loop);
  for (std::size_t i = 0; i < outside.loops.size(); ++i)
    outside.gains.push_back(random.log_uniform(0.3, 1.2) * random.sign());
}

bool is_slow(LoopKind kind) {
  return kind == LoopKind::level || kind == LoopKind::temperature;
}

/// A valve shakes a plant where its stream is a large one.
void widen_streams(PlantPlan& plan, std::size_t source, Random& random) {
  const double least = is_slow(plan.loops[source].kind) ? 3.0 : 2.0;
  for (Stream& stream : plan.streams)
    if (stream.from == source) stream.gain *= random.uniform(least, 2.0 * least);
}

/// The historian of a site keeps nothing slower than this; nor, where slow loops are what it is
/// for, much faster.
void limit_intervals(PlantPlan& plan, bool slow, Random& random) {
  const double slowest = random.pick({10.0, 15.0, 30.0});
  const double fastest = slow ? random.pick({2.0, 5.0, 10.0}) : 1.0;
  for (LoopPlan& loop : plan.loops) loop.interval_s = std::clamp(loop.interval_s, fastest, slowest);
}

/// Loops with a fault of their own that has nothing to do with the shared oscillation.
void add_unrelated(Draft& draft, Random& random) {
  const int count = random.whole(2, 5);
  for (int i = 0; i < count; ++i) {
    const auto loop = static_cast<std::size_t>(random.whole(0, 29));
    if (loop == draft.source || is_master(draft.with, loop)) continue;
    if (std::ranges::count(draft.unrelated, loop) > 0) continue;
    draft.unrelated.push_back(loop);
    if (random.chance(0.25))
      make_stick(draft.with.loops[loop], random);
    else
      make_tight(draft.with.loops[loop], random);
  }
}

/// A valve that stands near its end: the oscillation drives it into the stop.
void add_saturating(Draft& draft, Random& random) {
  for (int i = 0; i < 2; ++i) {
    const auto loop = static_cast<std::size_t>(random.whole(0, 29));
    if (loop == draft.source || is_master(draft.with, loop)) continue;
    draft.with.loops[loop].op0 =
        random.chance(0.5) ? random.uniform(1.0, 4.0) : random.uniform(96.0, 99.0);
    if (draft.with.loops[loop].valve) draft.with.loops[loop].valve = {};
  }
}

}  // namespace

Draft draw_plan(std::uint64_t seed, Origin origin, LoopKind kind) {
  Random random(effects::seed_for("plant", seed));
  Draft draft;
  PlantPlan& plan = draft.with;
  plan.noise_seed = random.next();
  const std::size_t steam = add(plan, LoopKind::pressure, "0PC01", 0, random);
  const std::size_t feed = add(plan, LoopKind::pressure, "0PC02", 0, random);
  std::vector<Unit> units;
  for (std::size_t number = 1; number <= 4; ++number)
    units.push_back(add_unit(plan, number, random));
  add_cascades(plan, units, random);
  plan.streams = draw_streams(units, steam, feed, random);
  limit_intervals(plan, is_slow(kind), random);
  if (origin != Origin::outside) draft.source = draw_source(plan, origin, kind, random);
  if (draft.source) widen_streams(plan, *draft.source, random);
  add_saturating(draft, random);
  add_unrelated(draft, random);
  draft.without = plan;
  if (draft.source)
    make_stick(plan.loops[*draft.source], random);
  else if (origin == Origin::outside)
    draw_outside(plan, units, random);
  return draft;
}

}  // namespace loopscope::tests::network
