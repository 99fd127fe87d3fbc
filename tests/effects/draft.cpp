#include "tests/effects/draft.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/effects/kinds.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr int kMostAttempts = 2000;

double share_at_limit(const std::vector<double>& op) {
  const auto count =
      std::count_if(op.begin(), op.end(), [](double v) { return v < 0.01 || v > 99.99; });
  return static_cast<double>(count) / static_cast<double>(op.size());
}

/// Whether pv stays on the span of its transmitter.
bool is_on_span(const Scenario& scenario, const std::vector<double>& pv) {
  return std::all_of(pv.begin(), pv.end(), [&](double rise) {
    return scenario.pv0 + rise > 0.0 && scenario.pv0 + rise < 100.0;
  });
}

bool holds(const Draft& draft, const Recipe& recipe, const Series& with) {
  if (!is_on_span(draft.base, with.pv) || share_at_limit(with.op) > recipe.most_at_limit)
    return false;
  if (draft.conditions.empty()) return true;
  const Series without = simulate(draft.base);
  return std::all_of(draft.conditions.begin(), draft.conditions.end(),
                     [&](const auto& condition) { return condition(with, without); });
}

Draft attempt(const Recipe& recipe, Random& random) {
  const int choice = random.whole(0, static_cast<int>(recipe.options.size()) - 1);
  LoopOptions options = recipe.options[static_cast<std::size_t>(choice)];
  if (options.moves == Moves::large) options.op_range = random.uniform(25.0, 45.0);
  Draft draft = draw_loop(options, random);
  for (const Dress dress : recipe.dresses) dress(draft, random);
  return draft;
}

}  // namespace

Finished finish(std::string_view kind, std::uint64_t seed) {
  const Recipe& recipe = recipe_of(kind);
  Random random(seed_for(kind, seed));
  for (int i = 1; i <= kMostAttempts; ++i) {
    Finished finished{attempt(recipe, random), {}, i};
    finished.series = simulate(finished.draft.scenario);
    if (!holds(finished.draft, recipe, finished.series)) continue;
    for (const auto& measure : finished.draft.measurements)
      measure(finished.draft, finished.series);
    return finished;
  }
  throw std::runtime_error("no loop of kind " + std::string(kind) + " keeps its conditions");
}

}  // namespace loopscope::tests::effects
