#include "tests/effects/draft.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/effects/explainable.hpp"
#include "tests/effects/kinds.hpp"
#include "tests/effects/realistic.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr int kMostAttempts = 2000;

/// Whether pv stays on the span of its transmitter.
bool is_on_span(const Scenario& scenario, const std::vector<double>& pv) {
  return std::all_of(pv.begin(), pv.end(), [&](double rise) {
    return scenario.pv0 + rise > 0.0 && scenario.pv0 + rise < 100.0;
  });
}

bool holds(const Draft& draft, const Recipe& recipe, const Series& with) {
  if (!stays_in_range(draft.base, with, recipe.most_at_limit)) return false;
  if (draft.conditions.empty()) return true;
  const Series without = simulate(draft.base);
  return std::all_of(draft.conditions.begin(), draft.conditions.end(),
                     [&](const auto& condition) { return condition(with, without); });
}

/// Whether each effect that has to be explainable is, by itself.
bool is_explainable(const Draft& draft) {
  return std::all_of(draft.alone.begin(), draft.alone.end(), [&](const Scenario& scenario) {
    return explainable({draft.base, scenario, simulate(scenario)}) >= kLeastExplainable;
  });
}

/// The loop with what `dress` is about to put in, and nothing else.
Scenario with_only(Dress dress, const Draft& draft, Random random) {
  Draft alone;
  alone.options = draft.options;
  alone.noise_std = draft.noise_std;
  alone.base = alone.scenario = draft.base;
  dress(alone, random);
  return alone.scenario;
}

Draft attempt(const Recipe& recipe, Random& random) {
  const int choice = random.whole(0, static_cast<int>(recipe.options.size()) - 1);
  LoopOptions options = recipe.options[static_cast<std::size_t>(choice)];
  if (options.moves == Moves::large) options.op_range = random.uniform(25.0, 45.0);
  Draft draft = draw_loop(options, random);
  for (const Dress dress : recipe.dresses) {
    if (std::find(recipe.spread.begin(), recipe.spread.end(), dress) != recipe.spread.end())
      draft.alone.push_back(with_only(dress, draft, random));
    dress(draft, random);
  }
  return draft;
}

}  // namespace

bool stays_in_range(const Scenario& scenario, const Series& series, double most_at_limit) {
  return is_on_span(scenario, series.pv) && share_at_limit(series.op) <= most_at_limit;
}

Finished finish(std::string_view kind, std::uint64_t seed, Size size) {
  const Recipe& recipe = recipe_of(kind, size);
  Random random(seed_for(kind, seed));
  for (int i = 1; i <= kMostAttempts; ++i) {
    Finished finished{attempt(recipe, random), {}, i};
    finished.series = simulate(finished.draft.scenario);
    if (!holds(finished.draft, recipe, finished.series) || !is_explainable(finished.draft))
      continue;
    for (const auto& measure : finished.draft.measurements)
      measure(finished.draft, finished.series);
    return finished;
  }
  throw std::runtime_error("no loop of kind " + std::string(kind) + " keeps its conditions");
}

}  // namespace loopscope::tests::effects
