#include "tests/effects/generator.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "tests/effects/draft.hpp"
#include "tests/effects/explainable.hpp"
#include "tests/effects/kinds.hpp"

namespace loopscope::tests::effects {
namespace {

/// From % of span and samples to the units of a plant.
struct Units {
  double interval_s = 1.0;
  double low = 0.0;   ///< pv at 0 % of span
  double unit = 1.0;  ///< pv by % of span

  [[nodiscard]] double scale(const std::string& name) const {
    if (name == "pv") return unit;
    if (name == "s") return interval_s;
    if (name == "1/h") return 3600.0 / interval_s;
    return 1.0;
  }
};

Units draw_units(std::string_view kind, std::uint64_t seed) {
  Random random(seed_for("units", seed_for(kind, seed)));
  const double span = random.pick({1.0, 100.0, 1000.0});
  return {random.pick({1.0, 5.0, 10.0, 60.0}), span * random.pick({0.0, 0.0, -0.5, 0.2}),
          span / 100.0};
}

std::vector<double> in_units(const std::vector<double>& rises, double pv0, const Units& units) {
  std::vector<double> values;
  values.reserve(rises.size());
  for (const double rise : rises) values.push_back(units.low + units.unit * (pv0 + rise));
  return values;
}

std::vector<TrueEffect> effects_of(const Draft& draft, const Units& units) {
  std::vector<TrueEffect> effects = draft.effects;
  for (TrueEffect& effect : effects)
    for (TrueParameter& parameter : effect.parameters)
      parameter.value *= units.scale(parameter.unit);
  return effects;
}

TrueLoop loop_of(const Scenario& base, const Units& units) {
  const Process& process = base.process;
  TrueLoop loop;
  loop.integrating = process.integrating;
  loop.gain = process.gain * units.unit;
  if (process.integrating) loop.gain /= process.tau * units.interval_s;
  loop.time_constant_s = process.integrating ? 0.0 : process.tau * units.interval_s;
  loop.second_time_constant_s = process.second_tau * units.interval_s;
  loop.delay_s = process.delay * units.interval_s;
  loop.controller_gain = base.controller.kc / units.unit;
  loop.integral_time_s = base.controller.ti * units.interval_s;
  loop.peak_sensitivity = LoopFrequency(process).peak_sensitivity(base.controller);
  return loop;
}

Record record_of(std::string_view kind, std::uint64_t seed, const Finished& finished) {
  const Scenario& scenario = finished.draft.scenario;
  const Units units = draw_units(kind, seed);
  Record record;
  record.interval_s = units.interval_s;
  record.sp = in_units(finished.series.sp, scenario.pv0, units);
  record.pv = in_units(finished.series.pv, scenario.pv0, units);
  record.op = finished.series.op;
  record.mv = finished.series.mv;
  record.truth = {recipe_of(kind).info,
                  effects_of(finished.draft, units),
                  loop_of(finished.draft.base, units),
                  floor_of(scenario) * units.unit * units.unit,
                  finished.draft.noise_std * units.unit,
                  explainable({finished.draft.base, scenario, finished.series})};
  return record;
}

}  // namespace

double share_at_limit(std::span<const double> op) {
  return static_cast<double>(std::ranges::count_if(op, is_at_limit)) /
         static_cast<double>(op.size());
}

double worst_share_at_limit(std::span<const double> op) {
  std::size_t inside = 0, most = 0;
  for (std::size_t k = 0; k < op.size(); ++k) {
    inside += is_at_limit(op[k]) ? 1U : 0U;
    if (k >= kSamples && is_at_limit(op[k - kSamples])) --inside;
    most = std::max(most, inside);
  }
  return static_cast<double>(most) / kEnd;
}

const std::vector<KindInfo>& all_kinds() {
  static const std::vector<KindInfo> kinds = [] {
    std::vector<KindInfo> all;
    for (const Recipe& recipe : all_recipes()) all.push_back(recipe.info);
    return all;
  }();
  return kinds;
}

Record generate(std::string_view kind, std::uint64_t seed, Size size, NoiseFamily noise) {
  Finished finished = finish(kind, seed, size);
  if (noise != NoiseFamily::gaussian) {
    finished.draft.scenario.noise_family = noise;
    finished.series = simulate(finished.draft.scenario);
  }
  return record_of(kind, seed, finished);
}

Record generate_stretch(std::string_view kind, std::uint64_t seed, std::uint64_t stretch) {
  Finished finished = finish(kind, seed, Size::realistic);
  if (stretch > 0) {
    Draft& draft = finished.draft;
    const std::uint64_t noise_seed = seed_for("stretch", draft.base.noise_seed + stretch);
    draft.base.noise_seed = draft.scenario.noise_seed = noise_seed;
    finished.series = simulate(draft.scenario);
  }
  return record_of(kind, seed, finished);
}

namespace {

/// For `samples` samples; the run-in stands still. No load integrates for so long: it returns
/// within a record, which a single record hardly shows.
Scenario lasting(Scenario scenario, std::size_t samples, std::uint64_t draw) {
  const std::vector<double> once = scenario.sp;
  scenario.sp.assign(kRunIn, once.front());
  for (std::size_t k = 0; k < samples; ++k)
    scenario.sp.push_back(once[kRunIn + k % (once.size() - kRunIn)]);
  scenario.noise_seed = seed_for("onset", scenario.noise_seed + draw);
  scenario.load.return_within(kEnd);
  return scenario;
}

/// As of a record, a draw that drives op to its limits is thrown away: the first of at most
/// kDraws that leaves it its room, else the one that does so most.
Series simulate_lasting(const Finished& finished, std::size_t before, std::size_t behind) {
  constexpr std::uint64_t kDraws = 12;
  const Draft& draft = finished.draft;
  // An effect that drives op to its limits in a single record may do so for twice as long here.
  const double once = draft.effects.empty() ? 0.0 : share_at_limit(finished.series.op);
  const double allowed = std::max(kMostAtLimit, 2.0 * once);
  Series best;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t draw = 0; draw < kDraws && least > 1.0; ++draw) {
    Series series = simulate_onset(lasting(draft.base, before + behind, draw),
                                   lasting(draft.scenario, before + behind, draw), before);
    const double of_allowed =
        std::max(worst_share_at_limit(std::span(series.op).first(before)) / kMostAtLimit,
                 worst_share_at_limit(series.op) / allowed);
    if (of_allowed >= least) continue;
    least = of_allowed;
    best = std::move(series);
  }
  return best;
}

}  // namespace

Record generate_onset(std::string_view kind, std::uint64_t seed, std::size_t before,
                      std::size_t behind) {
  const Finished finished = finish(kind, seed, Size::realistic);
  const Series series = simulate_lasting(finished, before, behind);
  const double pv0 = finished.draft.scenario.pv0;
  const Units units = draw_units(kind, seed);
  Record record;
  record.interval_s = units.interval_s;
  record.sp = in_units(series.sp, pv0, units);
  record.pv = in_units(series.pv, pv0, units);
  record.op = series.op;
  record.truth.kind = recipe_of(kind).info;
  record.truth.effects = effects_of(finished.draft, units);
  record.truth.loop = loop_of(finished.draft.base, units);
  return record;
}

}  // namespace loopscope::tests::effects
