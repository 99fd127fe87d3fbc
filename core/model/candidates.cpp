#include "core/model/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit_variants.hpp"
#include "core/model/hysteresis_net.hpp"
#include "core/model/nominate.hpp"

namespace loopscope::core::model {
namespace {

/// A sudden step is seen by fit and score over so many samples from so many before it on: as far as
/// its place may move while it is fitted. A place whose first sample the fit does not see leaves
/// one of its coefficients free.
constexpr std::size_t kStepBefore = 12;
constexpr std::size_t kStepSamples = 40;

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
  if (round.load_steps_only) return nominate_load_steps(round.data, round.now.fit);
  std::vector<EffectPtr> all = nominate_static(round.data);
  for (const auto& more :
       {nominate_gain_changes(round.data), nominate_load_steps(round.data, round.now.fit),
        nominate_oscillations(round.data, round.now.fit)}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

/// n ln(error before / after) on the fit rows.
double gain_of(const LoopData& rows, double before, double after) {
  return static_cast<double>(rows.rows.fit_count()) * std::log(before / after);
}

/// Behind an effect that bends op the process is another one.
Candidate look_through(const Round& round, const EffectPtr& effect) {
  Structure structure = with(round.now.fit.structure, effect);
  structure.process = glance(round.data, structure).shape;
  structure.two_taps = false;
  structure.second_order = false;
  const double error = evaluate(round.data, structure).fit_error;
  return {effect, std::move(structure), gain_of(round.data, round.now.fit.fit_error, error)};
}

/// A load step brings rows of its own.
Candidate look_at_step(const Round& round, const EffectPtr& effect) {
  Structure structure = with(round.now.fit.structure, effect);
  const LoopData rows = judged_on(round.original, structure);
  const double before = evaluate(rows, round.now.fit.structure).fit_error;
  const double after = evaluate(rows, structure).fit_error;
  return {effect, std::move(structure), gain_of(rows, before, after)};
}

/// First looks at effects, one after the other.
class Looks {
 public:
  explicit Looks(const Round& round) : round_(round) {}

  Candidate at(const EffectPtr& effect) {
    if (bends_flow(effect->kind())) return look_through(round_, effect);
    if (effect->kind() == EffectKind::load_step) return look_at_step(round_, effect);
    Structure structure = with(round_.now.fit.structure, effect);
    if (!straight_) straight_.emplace(round_.data, structure);
    const double error = straight_->fit_error(effect);
    return {effect, std::move(structure), gain_of(round_.data, round_.now.fit.fit_error, error)};
  }

 private:
  const Round& round_;
  std::optional<FitVariants> straight_;  ///< effects that leave the flow and the rows as they are
};

/// Valves by their law alone: sticking ones where play, which is cheap to look for, gains
/// something.
void add_hysteresis(const Round& round, std::vector<Candidate>& list) {
  constexpr double kWorthSearching = 5.0;
  const auto add = [&](const NetFind& find) {
    const double gain = gain_of(round.data, round.now.fit.fit_error, find.fit_error);
    list.push_back({find.structure.effects.back(), find.structure, gain});
    return gain;
  };
  const std::optional<NetFind> play = find_play(round.data, round.now.fit);
  if (!play || add(*play) < kWorthSearching) return;
  for (const NetFind& find : find_sticking(round.data, round.now.fit, *play)) add(find);
}

using Candidates = std::map<EffectKind, std::vector<Candidate>>;

/// The valve's two kinds go under one name: which it is shows when its jump has been fitted.
Candidates looked_at(const Round& round) {
  Candidates result;
  Looks looks(round);
  for (const EffectPtr& effect : nominees(round)) {
    if (has_room(round.now.fit.structure, effect->kind()))
      result[effect->kind()].push_back(looks.at(effect));
  }
  if (!round.load_steps_only && has_room(round.now.fit.structure, EffectKind::valve_stiction))
    add_hysteresis(round, result[EffectKind::valve_stiction]);
  for (auto& [kind, list] : result) std::ranges::sort(list, std::greater{}, &Candidate::gain);
  return result;
}

/// The law as far as a candidate has one, and whether pv puts it right: of the three valve laws and
/// plain play each is tried.
std::tuple<EffectKind, ValveLaw, bool> law_of(const Candidate& candidate) {
  const EffectKind kind = candidate.effect->kind();
  const auto* valve = dynamic_cast<const ValveEffect*>(candidate.effect.get());
  if (valve == nullptr) return {kind, ValveLaw::kano, true};
  const bool play = kind == EffectKind::valve_deadband;
  return {kind, play ? ValveLaw::kano : valve->valve().law, valve->by_law_alone()};
}

/// The best candidate of each law; of load steps all, since the error of one that is still to come
/// hides what another gains.
std::vector<Candidate> worth_trying(const std::vector<Candidate>& list) {
  if (!list.empty() && list.front().effect->kind() == EffectKind::load_step) return list;
  std::vector<Candidate> chosen;
  for (const Candidate& candidate : list) {
    const auto same = [&](const Candidate& other) { return law_of(other) == law_of(candidate); };
    if (std::ranges::none_of(chosen, same)) chosen.push_back(candidate);
  }
  return chosen;
}

}  // namespace

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

std::vector<Candidate> find_tracked_valves(const Round& round) {
  std::vector<Candidate> list;
  if (!has_room(round.now.fit.structure, EffectKind::valve_stiction)) return list;
  for (const EffectPtr& valve : round.tracked_valves()) list.push_back(look_through(round, valve));
  std::ranges::sort(list, std::greater{}, &Candidate::gain);
  return worth_trying(list);
}

std::vector<std::vector<Candidate>> find_candidates(const Round& round) {
  std::vector<std::vector<Candidate>> result;
  for (const auto& [kind, list] : looked_at(round)) result.push_back(worth_trying(list));
  return result;
}

}  // namespace loopscope::core::model
