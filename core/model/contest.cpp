#include "core/model/contest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/effects/catalogue.hpp"
#include "core/model/fit_anew.hpp"
#include "core/model/tell_bends_apart.hpp"

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
double hopeless_error(const Contestant& trial, const EffectTraits& traits) {
  return error_after(trial.rows, trial.before.fit.fit_error, least_gain(traits));
}

std::optional<Contestant> try_candidate(const Round& round, const Candidate& candidate) {
  const EffectTraits& traits = traits_of(candidate.effect->kind());
  const bool called_for = traits.fitted_when_asked && !round.unasked;
  if (!called_for && candidate.gain < traits.worth_fitting) return std::nullopt;
  Contestant trial{{}, {}, judged_on(round.original, candidate.structure), round.now, 0.0};
  if (traits.on_own_rows) trial.before = reevaluated(trial.rows, round.now);
  const double hopeless = hopeless_error(trial, traits);
  const double far_off = kFarOff * trial.before.fit.fit_error;
  Fit fit = fit_anew(trial.rows, evaluate(trial.rows, candidate.structure), far_off);
  if (!(fit.fit_error <= hopeless) || !is_plausible(fit)) return std::nullopt;
  Contestant entry = scored(std::move(trial), std::move(fit), candidate.tries);
  return entry.enters() && round.data.without.has(Mechanism::plainer_refuted) &&
                 !refutes_plainer(entry)
             ? std::nullopt
             : std::optional(std::move(entry));
}

std::optional<Contestant> best_of(const Round& round, const std::vector<Candidate>& candidates) {
  std::optional<Contestant> best;
  for (const Candidate& candidate : candidates) {
    std::optional<Contestant> entry = try_candidate(round, candidate);
    if (entry && (!best || entry->worth() > best->worth())) best = std::move(entry);
  }
  return best;
}

void rank(std::vector<Contestant>& entries) {
  std::ranges::sort(entries, std::greater{}, &Contestant::worth);
}

}  // namespace

std::vector<Contestant> hold_contest(const Round& round) {
  std::vector<Contestant> result;
  for (const std::vector<Candidate>& candidates : find_candidates(round)) {
    std::optional<Contestant> best = best_of(round, candidates);
    if (best) result.push_back(std::move(*best));
  }
  rank(result);
  tell_bends_apart(round.data, result);
  return result;
}

}  // namespace loopscope::core::model
