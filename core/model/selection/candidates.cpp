#include "core/model/selection/candidates.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit/trial.hpp"
#include "core/model/selection/nominate.hpp"
#include "core/model/valve_search/hysteresis_grid_search.hpp"
#include "core/model/valve_search/stiction_search.hpp"

namespace loopscope::core::model {
namespace {

/// n ln at the places looked at; where nothing changes the best of them gains 11 in the median
/// loop, 18 in one of ten, and has to come to an evidence of 30.
constexpr double kWorthPlacing = 15.0;

bool has_room(const Structure& structure, EffectKind kind) {
  const auto same = [&](const EffectPtr& effect) {
    return effect->kind() == kind ||
           (is_valve_hysteresis(kind) && is_valve_hysteresis(effect->kind()));
  };
  return std::ranges::count_if(structure.effects, same) < traits_of(kind).most;
}

/// At bends and limits that no test asks for a look won 16 times in 600 loops and was never right.
bool is_looked_at_unasked(const Round& round, EffectKind kind) {
  const CheapLook look = traits_of(kind).cheap_look;
  return look == CheapLook::where_hinted ? round.asked.hints_at(kind) : look == CheapLook::always;
}

/// Whether this round looks at such effects.
bool is_sought(const Round& round, EffectKind kind) {
  if (!has_room(round.now.fit.structure, kind)) return false;
  if (round.load_steps_only) return kind == EffectKind::load_step;
  const bool asked = round.asked.for_effect(kind);
  return round.reach == Reach::unasked ? !asked && is_looked_at_unasked(round, kind) : asked;
}

/// Valves by their law alone: sticking ones where play, which is cheap to look for, gains
/// something, and not next to nothing of what another effect gains: that one is first.
void add_hysteresis(const Round& round, double other_gain, std::vector<Candidate>& list) {
  constexpr double kLeastGain = 5.0;
  if (!round.data.without.keeps(Mechanism::play_net)) return;
  const double worth_searching = std::max(kLeastGain, 0.1 * other_gain);
  const auto add = [&](const GridResult& find) {
    const double gain = gain_of(round.data, round.now.fit.fit_error, find.fit_error);
    list.push_back({find.structure.effects.back(), find.structure, gain});
    return gain;
  };
  const Fit& now = round.now.fit;
  const std::optional<GridResult> play =
      find_play(round.data, now, error_after(round.data, now.fit_error, kLeastGain));
  if (!play || add(*play) < worth_searching || !can_seek_sticking(play->structure)) return;
  for (const GridResult& find : find_sticking(round.data, round.now.fit, *play)) add(find);
  if (!round.data.without.keeps(Mechanism::stem_search)) return;
  const EffectPtr& effect = play->structure.effects.back();
  const double band = effect->as_valve()->valve().stickband_percent;
  for (const ValveLaw law : {ValveLaw::he, ValveLaw::kano})
    add(find_stem(round.data, play->structure, band, law));
}

/// Load steps, changes of gain and lines are found by looking through all places and frequencies;
/// what a valve was chosen from shows when it has been fitted.
std::size_t tries_of(const Round& round, EffectKind kind, std::size_t nominees) {
  return traits_of(kind).everywhere ? round.data.size() : nominees;
}

/// The best few are put in place: where a level comes with the new gain, a net of places shows of a
/// sudden change what a slow one would explain as well.
void place_best(const EffectScreening& looks, std::vector<Candidate>& list) {
  constexpr std::size_t kPlaced = 3;
  for (std::size_t i = 0; i < std::min(kPlaced, list.size()); ++i) {
    if (list[i].gain >= kWorthPlacing) looks.put_in_place(list[i]);
  }
  std::ranges::sort(list, std::greater{}, &Candidate::gain);
}

double best_gain(const std::vector<Candidate>& list) {
  double best = 0.0;
  for (const Candidate& candidate : list) best = std::max(best, candidate.gain);
  return best;
}

/// Of the valve's laws and plain play each is tried, and of a bend each of its shapes, which differ
/// in their columns.
bool same_law(const Effect& a, const Effect& b) {
  const ValveEffect* valve = a.as_valve();
  const ValveEffect* other = b.as_valve();
  if (valve == nullptr || other == nullptr)
    return a.kind() == b.kind() && a.column_count() == b.column_count();
  const bool both_play = a.kind() == EffectKind::valve_deadband && b.kind() == a.kind();
  return both_play || (a.kind() == b.kind() && valve->valve().law == other->valve().law &&
                       valve->valve().acts_at_samples() == other->valve().acts_at_samples());
}

/// The best candidate of each law; of load steps all, since the error of one that is still to come
/// hides what another gains.
std::vector<Candidate> worth_trying(const std::vector<Candidate>& list) {
  if (!list.empty() && traits_of(list.front().effect->kind()).scored_once) return list;
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

CandidateSearch::CandidateSearch(const Round& round) : round_(round), looks_(round) {
  for (const EffectKind kind : all_effect_kinds()) {
    // The valve's two kinds go under one name: which it is shows when its jump has been fitted.
    if (kind == EffectKind::valve_deadband || !is_sought(round, kind)) continue;
    SoughtKind sought = look_at(kind);
    if (sought.looked_at.empty() && kind != EffectKind::valve_stiction) continue;
    kinds_.push_back(std::move(sought));
    best_look_ = std::max(best_look_, best_gain(kinds_.back().looked_at));
  }
  std::ranges::stable_sort(kinds_, std::greater{}, &SoughtKind::promise);
}

SoughtKind CandidateSearch::look_at(EffectKind kind) {
  SoughtKind sought{kind, 0.0, {}};
  for (const EffectPtr& effect :
       nominate(kind, round_.data, round_.now.fit, round_.asked.nominations(kind)))
    sought.looked_at.push_back(looks_.at(effect));
  sought.promise = std::max(round_.asked.promise(kind), best_gain(sought.looked_at));
  return sought;
}

std::vector<Candidate> CandidateSearch::worth_fitting(const SoughtKind& sought) const {
  std::vector<Candidate> list = sought.looked_at;
  if (sought.kind == EffectKind::valve_stiction && round_.reach != Reach::unasked)
    add_hysteresis(round_, best_look_, list);
  std::ranges::sort(list, std::greater{}, &Candidate::gain);
  if (traits_of(sought.kind).put_in_place) place_best(looks_, list);
  for (Candidate& candidate : list) candidate.tries = tries_of(round_, sought.kind, list.size());
  return worth_trying(list);
}

}  // namespace loopscope::core::model
