#include "tests/plants/process/process_plant.hpp"

#include <algorithm>
#include <stdexcept>

#include "tests/plants/process/column.hpp"
#include "tests/plants/process/evaporator.hpp"
#include "tests/plants/process/four_tanks.hpp"
#include "tests/plants/process/reactor_recycle.hpp"
#include "tests/plants/process/recording.hpp"
#include "tests/plants/process/truth.hpp"

namespace loopscope::tests::process {
namespace {

constexpr std::uint64_t kMostDrafts = 300;
constexpr double kPilotSteps = 4000.0;
constexpr double kSourcePeriods = 12.0;
constexpr double kSourceSamples = 5.0;

PlantPlan draft_plan(PlantKind kind, std::uint64_t seed) {
  switch (kind) {
    case PlantKind::evaporator:
      return draft_evaporator(seed);
    case PlantKind::reactor_recycle:
      return draft_reactor_recycle(seed);
    case PlantKind::column:
      return draft_column(seed);
    case PlantKind::four_tanks:
      return draft_four_tanks(seed);
  }
  throw std::invalid_argument("there is no such plant");
}

std::optional<Twins> run_twins(const Draft& draft, const std::vector<Window>& windows) {
  Twins twins{simulate(draft.with, windows), {}};
  if (!runs_well(draft, twins.with)) return std::nullopt;
  // Spares the second run for what does not swing.
  if (!draft.set_period_s && !swings(twins.with[*draft.source])) return twins;
  twins.without = simulate(draft.without, windows);
  if (twins.without.empty()) return std::nullopt;
  return twins;
}

/// So many loops carry it that one would speak of a shaken plant.
bool shaken(const std::vector<ProcessLoop>& loops, std::optional<std::size_t> source) {
  return (!source || loops[*source].carries) &&
         std::ranges::count_if(loops, &ProcessLoop::carries) >= 3;
}

/// Hardly a swing of the source, or of the loop above it, takes longer.
double slowest_s(const Draft& draft) {
  if (!draft.source) return 0.0;
  const LoopPlan& loop = draft.with.loops[*draft.source];
  const double above_s =
      loop.master ? draft.with.loops[*loop.master].integral_time_s : loop.integral_time_s;
  return 12.0 * std::max(loop.integral_time_s, above_s);
}

std::vector<Window> pilot_windows(const PlantPlan& plan, double steps) {
  const long every = std::max(1L, std::lround(steps / kPilotSteps));
  const auto samples = static_cast<std::size_t>(steps / static_cast<double>(every));
  return std::vector<Window>(plan.loops.size(), {.samples = samples, .every = every});
}

/// A short run first, longer where the cycle is slow: most drafts are thrown away.
std::optional<double> pilot_period(Draft draft) {
  draft.with.settle_s = draft.without.settle_s = draft.with.settle_s / 8.0;
  const double step_s = draft.with.step_s;
  double steps = std::max(kPilotSteps, 10.0 * draft.set_period_s.value_or(0.0) / step_s);
  while (steps <= 20.0 * kPilotSteps) {
    const std::optional<Twins> twins = run_twins(draft, pilot_windows(draft.with, steps));
    if (!twins) return std::nullopt;
    const std::optional<double> period_s = period_of(draft, *twins);
    if (!period_s && steps * step_s > 3.0 * slowest_s(draft)) return std::nullopt;
    const double wanted = period_s ? 9.0 * *period_s / step_s : 4.0 * steps;
    if (wanted <= steps)
      return shaken(loops_of(draft, *twins, *period_s), draft.source) ? period_s : std::nullopt;
    steps = wanted;
  }
  return std::nullopt;
}

std::vector<std::pair<std::size_t, std::size_t>> cascades_of(const PlantPlan& plan) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < plan.loops.size(); ++i)
    if (plan.loops[i].master) pairs.emplace_back(*plan.loops[i].master, i);
  return pairs;
}

ProcessPlant plant_of(const Draft& draft, Twins twins, double period_s) {
  ProcessPlant plant;
  plant.kind = draft.with.kind;
  plant.loops = loops_of(draft, std::move(twins), period_s);
  plant.source = draft.source;
  plant.cascades = cascades_of(draft.with);
  plant.period_s = period_s;
  return plant;
}

bool source_shows(const ProcessPlant& plant) {
  if (!plant.source) return true;
  const ProcessLoop& loop = plant.loops[*plant.source];
  const double length_s = loop.interval_s * static_cast<double>(loop.pv.size());
  return plant.period_s >= kSourceSamples * loop.interval_s &&
         length_s >= kSourcePeriods * plant.period_s;
}

std::optional<ProcessPlant> try_calm(const PlantPlan& plan, Random& random) {
  const auto windows = draw_windows(plan, 0.0, random);
  if (!windows) return std::nullopt;
  const Draft draft{plan, plan, std::nullopt, std::nullopt};
  Twins twins{simulate(plan, *windows), {}};
  if (!runs_well(draft, twins.with) || !is_calm(twins.with)) return std::nullopt;
  return plant_of(draft, std::move(twins), 0.0);
}

std::optional<ProcessPlant> try_shaken(const PlantPlan& plan, Cause cause, Valves valves,
                                       Random& random) {
  const std::optional<Draft> draft = put_cause(plan, cause, valves, random);
  if (!draft) return std::nullopt;
  const std::optional<double> expected_s = pilot_period(*draft);
  if (!expected_s) return std::nullopt;
  const auto windows = draw_windows(plan, *expected_s, random);
  if (!windows) return std::nullopt;
  std::optional<Twins> twins = run_twins(*draft, *windows);
  if (!twins || !is_calm(twins->without)) return std::nullopt;
  const std::optional<double> period_s = period_of(*draft, *twins);
  if (!period_s) return std::nullopt;
  ProcessPlant plant = plant_of(*draft, std::move(*twins), *period_s);
  if (!shaken(plant.loops, plant.source) || !source_shows(plant)) return std::nullopt;
  return plant;
}

}  // namespace

ProcessPlant draw_process_plant(PlantKind kind, Cause cause, std::uint64_t seed) {
  const std::uint64_t of_kind =
      seed_of_part(seed, 10 * static_cast<std::uint64_t>(kind) + static_cast<std::uint64_t>(cause));
  // By the plant's number, so that flow loops, which shake a plant more often, do not crowd out the
  // others.
  const bool direct_first = Random(of_kind).chance(0.4);
  for (std::uint64_t attempt = 1; attempt <= kMostDrafts; ++attempt) {
    Random random(seed_of_part(of_kind, attempt));
    const PlantPlan plan = draft_plan(kind, random.seed());
    const Valves valves = direct_first && attempt <= 30 ? Valves::direct : Valves::any;
    std::optional<ProcessPlant> plant =
        cause == Cause::none ? try_calm(plan, random) : try_shaken(plan, cause, valves, random);
    if (!plant) continue;
    plant->cause = cause;
    plant->drafts = attempt;
    draw_gaps(plant->loops, random);
    return std::move(*plant);
  }
  throw std::runtime_error("no draft is shaken by its cause, seed " + std::to_string(seed));
}

}  // namespace loopscope::tests::process
