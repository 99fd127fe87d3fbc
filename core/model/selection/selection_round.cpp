#include "core/model/selection/selection_round.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/selection/candidates.hpp"
#include "core/model/selection/fit_candidate.hpp"
#include "core/model/selection/locate_static_nonlinearity.hpp"

namespace loopscope::core::model {
namespace {

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
