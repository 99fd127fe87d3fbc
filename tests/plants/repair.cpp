#include "tests/plants/repair.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "tests/effects/explainable.hpp"
#include "tests/effects/realistic.hpp"
#include "tests/plants/repair_fault.hpp"

namespace loopscope::tests::repairs {
namespace {

using effects::Draft;
using effects::Random;
using effects::Scenario;
using effects::Series;

constexpr int kMostAttempts = 3000;
/// A fault of tuning has to cost at least so much, by the error's mean square without it.
constexpr double kLeastCost = 1.6;
/// A fault is smaller when its burden is at most this share of what it was, larger when the reverse
/// holds: a smaller change an engineer would not call one.
constexpr double kSmaller = 0.65;
/// Stretches over which the mean square in the long run is taken.
constexpr std::uint64_t kStretches = 3;
/// Work on a loop that was not wrong, of all that changes nothing or makes worse.
constexpr double kNeedless = 0.25;
/// The plant is not the same twice: noise and load of a side, and of each window on it.
constexpr double kSideSpread = 1.15;
constexpr double kWindowSpread = 1.05;

/// Sizes of the fault; nullopt = there is none.
struct Sizes {
  std::optional<double> before;
  std::optional<double> after;
};

Sizes draw_sizes(Word word, Random& random) {
  const double large = random.uniform(0.6, 1.0);
  const double small = std::max(0.0, large - random.uniform(0.4, 0.7));
  const double any = random.uniform(0.2, 1.0);
  const bool needless = random.chance(kNeedless);
  switch (word) {
    case Word::fixed:
      return {any, std::nullopt};
    case Word::improved:
      return {large, small};
    case Word::worse:
      return needless ? Sizes{std::nullopt, large} : Sizes{small, large};
    case Word::unchanged:
      return needless ? Sizes{} : Sizes{any, any};
  }
  throw std::invalid_argument("no such word");
}

/// A loop, its fault and the two states that are compared.
struct Trial {
  const FaultKind& kind;
  Draft draft;
  PutFault put;
  Sizes sizes;
  std::vector<double> program = {};  ///< set points of a stretch, run-in included

  [[nodiscard]] Scenario scenario(const std::optional<double>& size) const {
    Scenario scenario = draft.base;
    if (size) put(scenario, *size);
    return scenario;
  }
};

/// A state over one stretch.
struct Stretch {
  Scenario scenario;
  Series series;
};

/// A plant makes the same products before and after: the same moves, from another one on.
std::vector<double> begun_anywhere(std::vector<double> program, Random& random) {
  const int first = random.whole(0, static_cast<int>(program.size()) - 1);
  std::rotate(program.begin(), program.begin() + first, program.end());
  return program;
}

Stretch run(const Trial& trial, Scenario scenario, double noise, std::uint64_t seed) {
  Random random(seed);
  scenario.noise_seed = random.next();
  scenario.load.scale *= noise;
  scenario.noise_sd *= noise;
  scenario.sp = begun_anywhere(trial.program, random);
  Series series = effects::simulate(scenario);
  return {std::move(scenario), std::move(series)};
}

double mean_square_error(const Series& series) {
  double sum = 0.0;
  for (std::size_t k = 0; k < series.pv.size(); ++k)
    sum += (series.sp[k] - series.pv[k]) * (series.sp[k] - series.pv[k]);
  return sum / static_cast<double>(series.pv.size());
}

/// What a state costs in the long run.
struct Cost {
  double variance = 0.0;
  double explainable = 0.0;
  bool in_range = true;
};

double explainable_of(const Trial& trial, const Stretch& stretch) {
  Scenario base = trial.draft.base;
  base.controller = stretch.scenario.controller;
  base.sp = stretch.scenario.sp;
  base.process.gain = stretch.scenario.process.gain;
  return effects::explainable({base, stretch.scenario, stretch.series});
}

Cost cost_of(const Trial& trial, const std::optional<double>& size, std::uint64_t seed) {
  Cost cost;
  for (std::uint64_t i = 0; i < kStretches; ++i) {
    const Stretch stretch = run(trial, trial.scenario(size), 1.0, seed + i);
    cost.in_range &=
        effects::stays_in_range(trial.draft.base, stretch.series, effects::kMostAtLimit);
    cost.variance += mean_square_error(stretch.series) / kStretches;
    if (trial.kind.is_spread && size)
      cost.explainable += explainable_of(trial, stretch) / kStretches;
  }
  return cost;
}

/// Whether the fault of that size is one: seen by somebody who knows the loop.
bool shows(const Trial& trial, const Cost& faulty, const Cost& sound) {
  if (trial.kind.burden == Burden::size) return true;
  if (trial.kind.is_spread) return faulty.explainable >= effects::kLeastExplainable;
  return faulty.variance >= kLeastCost * sound.variance;
}

bool is_smaller(const Trial& trial, const Cost& less, const Cost& more) {
  switch (trial.kind.burden) {
    case Burden::variance:
      return less.variance <= kSmaller * more.variance;
    case Burden::explainable:
      return less.explainable <= kSmaller * more.explainable;
    case Burden::size:
      return true;
  }
  return false;
}

/// Whether the two states differ by what `word` says. Two faults have to show both, and one of them
/// to be clearly the smaller.
bool tells(const Trial& trial, const Cost& before, const Cost& after, const Cost& sound) {
  if (!before.in_range || !after.in_range || !sound.in_range) return false;
  const auto& [old_size, new_size] = trial.sizes;
  if (old_size && !shows(trial, before, sound)) return false;
  if (new_size && !shows(trial, after, sound)) return false;
  if (!old_size || !new_size || *old_size == *new_size) return true;
  return *new_size < *old_size ? is_smaller(trial, after, before)
                               : is_smaller(trial, before, after);
}

std::vector<Series> windows_of(const Trial& trial, const std::optional<double>& size,
                               Random& random) {
  const double side = random.log_uniform(1.0 / kSideSpread, kSideSpread);
  std::vector<Series> windows(static_cast<std::size_t>(random.whole(1, 4)));
  for (Series& window : windows) {
    const double noise = side * random.log_uniform(1.0 / kWindowSpread, kWindowSpread);
    window = run(trial, trial.scenario(size), noise, random.next()).series;
    for (double& value : window.sp) value += trial.draft.base.pv0;
    for (double& value : window.pv) value += trial.draft.base.pv0;
  }
  return windows;
}

Trial draw_trial(const FaultKind& kind, Word word, Random& random) {
  Trial trial{kind, effects::draw_loop(kind.options, random), {}, draw_sizes(word, random), {}};
  trial.put = kind.draw(trial.draft, random);
  Draft draft = trial.draft;
  const std::optional<double> larger = std::max(trial.sizes.before, trial.sizes.after);
  draft.scenario = trial.scenario(larger);
  effects::draw_moves(draft, random);
  trial.program = std::move(draft.scenario.sp);
  return trial;
}

std::optional<Repair> attempt(const FaultKind& kind, Word word, Random& random) {
  const Trial trial = draw_trial(kind, word, random);
  const std::uint64_t seed = random.next();
  const Cost sound = cost_of(trial, std::nullopt, seed);
  const Cost before = cost_of(trial, trial.sizes.before, seed);
  const Cost after = cost_of(trial, trial.sizes.after, seed);
  if (!tells(trial, before, after, sound)) return std::nullopt;
  Repair repair;
  repair.fault = kind.name;
  repair.word = word;
  repair.event_kind = kind.event_kind;
  repair.work = kind.work;
  repair.integrating = trial.draft.base.process.integrating;
  repair.interval_s = random.pick({1.0, 5.0, 10.0, 60.0});
  repair.before = windows_of(trial, trial.sizes.before, random);
  repair.after = windows_of(trial, trial.sizes.after, random);
  repair.variance_ratio = after.variance / before.variance;
  if (!trial.sizes.before) repair.fault = (trial.sizes.after ? "new " : "no ") + repair.fault;
  return repair;
}

}  // namespace

std::string_view name(Word word) {
  constexpr std::array<std::string_view, kWords> kNames = {"fixed", "improved", "unchanged",
                                                           "worse"};
  return kNames.at(static_cast<std::size_t>(word));
}

Repair draw_repair(Word word, std::uint64_t seed) {
  Random random(effects::seed_for(name(word), seed));
  const auto& kinds = fault_kinds();
  const int place = random.whole(0, static_cast<int>(kinds.size()) - 1);
  for (int i = 0; i < kMostAttempts; ++i) {
    auto repair = attempt(kinds[static_cast<std::size_t>(place)], word, random);
    if (repair) return std::move(*repair);
  }
  throw std::runtime_error("no loop keeps the conditions of a repair, " +
                           kinds[static_cast<std::size_t>(place)].name);
}

}  // namespace loopscope::tests::repairs
