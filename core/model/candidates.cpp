#include "core/model/candidates.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <typeinfo>

#include "core/model/baseline.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/nominate.hpp"
#include "core/model/trial.hpp"

namespace loopscope::core::model {
namespace {

/// A sudden step is seen by fit and score over so many samples from two before it on.
constexpr std::size_t kStepBefore = 2;
constexpr std::size_t kStepSamples = 16;

/// Changes of gain that lie closer together are hardly told apart.
constexpr std::size_t kPlace = 64;

/// n ln on the coarse net of places; the best of them all gains about 4 where nothing changes.
constexpr double kWorthPlacing = 5.0;

/// How often one kind may come.
std::ptrdiff_t most_of(EffectKind kind) {
  if (kind == EffectKind::load_step) return 3;
  return kind == EffectKind::external_oscillation ? 2 : 1;
}

bool has_room(const Structure& structure, EffectKind kind) {
  const auto same = [&](const EffectPtr& effect) {
    return effect->kind() == kind ||
           (is_valve_hysteresis(kind) && is_valve_hysteresis(effect->kind()));
  };
  return std::ranges::count_if(structure.effects, same) < most_of(kind);
}

Structure with(Structure structure, EffectPtr effect) {
  structure.effects.push_back(std::move(effect));
  return structure;
}

std::vector<EffectPtr> nominees(const Round& round) {
  std::vector<EffectPtr> all = nominate_static(round.data);
  for (const auto& more :
       {nominate_gain_changes(round.data), nominate_load_steps(round.data, round.now.fit),
        nominate_oscillations(round.data, round.now.fit)}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  if (has_room(round.now.fit.structure, EffectKind::valve_stiction)) {
    all.insert(all.end(), round.valves.begin(), round.valves.end());
  }
  return all;
}

/// The rows of a round and the model as it stands on them.
struct View {
  LoopData rows;
  Fit before;
};

View whole_view(const Round& round) {
  View view{seen_whole(round.data), {}};
  view.before = evaluate(view.rows, round.now.fit.structure);
  return view;
}

View fit_view(const Round& round, const Structure& structure, EffectKind kind) {
  View view{judged_on(round.original, structure), round.now.fit};
  if (kind == EffectKind::load_step) view.before = evaluate(view.rows, round.now.fit.structure);
  return view;
}

Candidate look_at(const Round& round, const View& whole, const EffectPtr& effect) {
  const EffectKind kind = effect->kind();
  Structure structure = with(round.now.fit.structure, effect);
  const bool all = looked_at_whole(kind);
  if (bends_flow(kind)) {
    structure.process = glance(all ? whole.rows : round.data, structure).shape;
    structure.two_taps = false;
    structure.second_order = false;
  }
  const View part = all ? View{} : fit_view(round, structure, kind);
  const View& view = all ? whole : part;
  const double gain = fit_gain(view.rows, view.before, evaluate(view.rows, structure));
  return {effect, std::move(structure), gain};
}

/// Found by looking through all places, frequencies or bands on all rows.
bool sought_everywhere(EffectKind kind) {
  return kind == EffectKind::load_step || kind == EffectKind::external_oscillation ||
         is_valve_hysteresis(kind);
}

std::size_t tries_of(const Round& round, EffectKind kind, std::size_t nominees) {
  if (kind == EffectKind::gain_change) return round.data.size() / kPlace;
  return sought_everywhere(kind) ? round.data.size() : nominees;
}

/// The place of a change, to a few samples.
void put_in_place(const View& whole, Candidate& candidate) {
  const Fit fit = refine_last(whole.rows, evaluate(whole.rows, candidate.structure));
  candidate.structure = fit.structure;
  candidate.effect = fit.structure.effects.back();
  candidate.gain = fit_gain(whole.rows, whole.before, fit);
}

using Candidates = std::map<EffectKind, std::vector<Candidate>>;

/// The valve's two kinds go under one name: which it is shows when its jump has been fitted.
Candidates looked_at(const Round& round) {
  Candidates result;
  const View whole = whole_view(round);
  for (const EffectPtr& effect : nominees(round)) {
    const EffectKind kind =
        is_valve_hysteresis(effect->kind()) ? EffectKind::valve_stiction : effect->kind();
    if (has_room(round.now.fit.structure, kind))
      result[kind].push_back(look_at(round, whole, effect));
  }
  for (auto& [kind, list] : result) {
    std::ranges::sort(list, std::greater{}, &Candidate::gain);
    const bool placed = kind == EffectKind::gain_change && list.front().gain >= kWorthPlacing;
    if (placed) put_in_place(whole, list.front());
    for (Candidate& candidate : list) candidate.tries = tries_of(round, kind, list.size());
  }
  return result;
}

/// Of the three valve laws and plain play each is tried, and of a bend each of its shapes.
bool same_law(const Effect& a, const Effect& b) {
  return typeid(a) == typeid(b) && a.law() == b.law();
}

/// The best candidate of each law; of load steps all, since the error of one that is still to come
/// hides what another gains.
std::vector<Candidate> worth_trying(const std::vector<Candidate>& list) {
  if (!list.empty() && list.front().effect->kind() == EffectKind::load_step) return list;
  std::vector<Candidate> chosen;
  for (const Candidate& candidate : list) {
    const auto same = [&](const Candidate& other) {
      return same_law(*other.effect, *candidate.effect);
    };
    if (std::ranges::none_of(chosen, same)) chosen.push_back(candidate);
  }
  return chosen;
}

}  // namespace

bool looked_at_whole(EffectKind kind) {
  using enum EffectKind;
  return kind == valve_saturation || kind == valve_characteristic || kind == process_nonlinearity ||
         kind == gain_change;
}

LoopData judged_on(const LoopData& original, const Structure& structure) {
  LoopData data = original;
  for (const EffectPtr& effect : structure.effects) {
    if (const auto* step = dynamic_cast<const LoadStep*>(effect.get())) {
      const std::size_t from = step->at() < kStepBefore ? 0 : step->at() - kStepBefore;
      data.rows = seen_by_both(data.rows, from, kStepSamples);
    }
  }
  return data;
}

std::vector<std::vector<Candidate>> find_candidates(const Round& round) {
  std::vector<std::vector<Candidate>> result;
  for (const auto& [kind, list] : looked_at(round)) result.push_back(worth_trying(list));
  return result;
}

}  // namespace loopscope::core::model
