#include "core/model/selection/selection_round.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/fit/trial.hpp"
#include "core/model/selection/candidate_fit.hpp"
#include "core/model/selection/locate_static_nonlinearity.hpp"
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
  std::vector<GridResult> finds = find_sticking(round.data, round.now.fit, *play);
  const EffectPtr& effect = play->structure.effects.back();
  const double band = effect->as_valve()->valve().stickband_percent;
  const Structure rival = std::ranges::min_element(finds, {}, &GridResult::fit_error)->structure;
  for (const ValveLaw law : {ValveLaw::he, ValveLaw::kano}) {
    if (!round.data.without.keeps(Mechanism::stem_search)) break;
    finds.push_back(find_stem(round.data, play->structure, band, law, 0, &rival));
  }
  for (const GridResult& find : finds) add(find);
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

/// Of the error without it: a valve that is further off once the process has been searched behind
/// it is not followed to its needle. One that is a little off may still have it before it.
constexpr double kFarOff = 1.1;

/// What was looked at on all rows has shown its worth there: on the fit rows, about its parameters.
double least_gain(const EffectTraits& traits) {
  constexpr double kWorthScoring = 3.0;
  return traits.looked_at_whole ? kWorthScoring : traits.worth_fitting;
}

/// The error on the fit rows above which such an effect is not worth while.
double hopeless_error(const CandidateFit& trial, const EffectTraits& traits) {
  return error_after(trial.rows, trial.before.fit.fit_error, least_gain(traits));
}

bool is_fitted_unseen(const Round& round, const EffectTraits& traits) {
  return traits.fitted_when_asked && round.reach != Reach::unasked &&
         std::ranges::none_of(round.now.fit.structure.effects, [&](const EffectPtr& effect) {
           return effect->kind() == traits.kind;
         });
}

std::optional<CandidateFit> try_candidate(const Round& round, const Candidate& candidate) {
  const EffectTraits& traits = traits_of(candidate.effect->kind());
  if (!is_fitted_unseen(round, traits) && candidate.gain < traits.worth_fitting)
    return std::nullopt;
  CandidateFit trial{{}, {}, judged_on(round.original, candidate.structure), round.now, 0.0};
  if (traits.on_own_rows) trial.before = reevaluated(trial.rows, round.now);
  const double hopeless = hopeless_error(trial, traits);
  const double far_off = kFarOff * trial.before.fit.fit_error;
  Fit fit = fit_candidate(trial.rows, evaluate(trial.rows, candidate.structure), far_off);
  if (!(fit.fit_error <= hopeless) || !is_plausible(fit)) return std::nullopt;
  CandidateFit entry = scored(std::move(trial), std::move(fit), candidate.tries);
  return entry.enters() && round.data.without.keeps(Mechanism::plainer_refuted) &&
                 !refutes_plainer(entry)
             ? std::nullopt
             : std::optional(std::move(entry));
}

struct Leader {
  EffectKind kind = EffectKind::load_step;
  double worth = 0.0;  ///< 0 = none
};

/// Whether the best trial so far is worth so many times what a kind promises that trying it is not
/// worth while: of 395 rounds that an effect came out of (`generate()` of tests/effects, seeds
/// 795000 on) none went to a kind that promised a fifth of another's worth or less, but between
/// bends, of which a first look may see nothing and which are told apart with all of them fitted.
bool is_outdone(const SoughtKind& sought, const Leader& leader) {
  constexpr double kOutdone = 5.0;
  return leader.worth > kOutdone * sought.promise &&
         !(is_bend(sought.kind) && is_bend(leader.kind));
}

bool outdoes_others(const Round& round) {
  return round.reach == Reach::promising && round.data.without.keeps(Mechanism::outdone_skipped);
}

std::optional<CandidateFit> best_of(const Round& round, const std::vector<Candidate>& candidates) {
  std::optional<CandidateFit> best;
  for (const Candidate& candidate : candidates) {
    std::optional<CandidateFit> entry = try_candidate(round, candidate);
    if (entry && (!best || entry->worth() > best->worth())) best = std::move(entry);
  }
  return best;
}

void rank(std::vector<CandidateFit>& entries) {
  std::ranges::sort(entries, std::greater{}, &CandidateFit::worth);
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

SelectionOutcome run_selection_round(const Round& round) {
  SelectionOutcome contest;
  CandidateSearch search(round);
  Leader leader;
  for (const SoughtKind& sought : search.kinds()) {
    if (is_outdone(sought, leader)) {
      contest.outdone_by = leader.kind;
      contest.passed_over = std::max(contest.passed_over, sought.promise);
      continue;
    }
    std::optional<CandidateFit> best = best_of(round, search.worth_fitting(sought));
    if (!best) continue;
    if (outdoes_others(round) && best->enters() && best->worth() > leader.worth && foresees(*best))
      leader = {best->kind(), best->worth()};
    contest.trials.push_back(std::move(*best));
  }
  rank(contest.trials);
  locate_static_nonlinearity(round.data, contest.trials);
  return contest;
}

}  // namespace loopscope::core::model
