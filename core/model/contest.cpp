#include "core/model/contest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit_anew.hpp"
#include "core/model/hysteresis_net.hpp"
#include "core/model/stem_search.hpp"
#include "core/model/tell_bends_apart.hpp"

namespace loopscope::core::model {
namespace {

/// An effect that does not gain so much (n ln) where it was fitted gains nothing on unseen rows.
constexpr double kWorthFitting = 8.0;
/// The same where all rows are looked at: less than what a later p of 0.001 asks for.
constexpr double kWorthFittingWhole = 11.0;
/// On the fit rows, of an effect that has shown so much on all: about its parameters.
constexpr double kWorthScoring = 3.0;

/// Of the error without it: a valve that is further off once the process has been searched behind
/// it is not followed to its needle. One that is a little off may still have it before it.
constexpr double kFarOff = 1.1;

/// The same by kind: the best of thousands of places or frequencies gains 8 by chance in every
/// loop, and has to reach an evidence of 30 with its tries. Over 376 loops none did from less
/// than 13.5 (a step, scored once) or 10.6 (a line, scored on both halves). The best change of gain
/// gains more than 18, on all rows, in one healthy loop of ten.
double worth_fitting(EffectKind kind) {
  if (kind == EffectKind::load_step) return 12.0;
  if (kind == EffectKind::gain_change) return 18.0;
  if (kind == EffectKind::external_oscillation) return 10.0;
  return looked_at_whole(kind) ? kWorthFittingWhole : kWorthFitting;
}

/// What it gains is counted once: where it sits (a step) or where pv puts it right (a valve) was
/// taken from the fit rows, so that the mirrored fit has nothing unseen to be scored on.
bool scored_once(const Effect& effect) {
  const auto* valve = dynamic_cast<const ValveEffect*>(&effect);
  return effect.kind() == EffectKind::load_step || (valve != nullptr && !valve->by_law_alone());
}

/// What a valve was chosen from shows when it has been fitted: play is smooth in its band, and only
/// so many bands differ.
double tries_of(const Candidate& candidate, const Effect& fitted, std::size_t samples) {
  const auto* valve = dynamic_cast<const ValveEffect*>(&fitted);
  if (valve == nullptr) return static_cast<double>(std::max<std::size_t>(candidate.tries, 1));
  const bool play = valve->by_law_alone() && valve->valve().slip_jump_percent == 0.0;
  if (play && valve->valve().acts_at_samples()) return static_cast<double>(hysteresis_net_bands());
  return static_cast<double>(valve->valve().acts_at_samples() ? samples : kStemGuesses);
}

Structure without_last(Structure structure) {
  structure.effects.pop_back();
  return structure;
}

/// The mirrored fit of what is scored once waits until it has won: nothing is read from it before.
TwinFit scored_fit(const LoopData& rows, Fit fit, bool once) {
  if (once) return {std::move(fit), {}};
  return twin(rows, std::move(fit));
}

/// A trial searches the process again, and may leave a local optimum that the model without the
/// effect sits in. What that gains is not the effect's: it is compared with the better of both.
void compare_fairly(Contestant& trial) {
  const bool once = scored_once(trial.effect());
  trial.comparison = compare(trial.rows, trial.before, trial.fit, once);
  if (trial.comparison.evidence <= 0.0) return;
  const TwinFit bare =
      scored_fit(trial.rows, polish(trial.rows, without_last(trial.fit.fit.structure)), once);
  const Comparison fair = compare(trial.rows, bare, trial.fit, once);
  if (fair.evidence >= trial.comparison.evidence) return;
  trial.comparison = fair;
  trial.before = bare;
}

Contestant finished(Contestant trial, Fit fit, const Candidate& candidate) {
  const bool once = scored_once(*fit.structure.effects.back());
  trial.fit = scored_fit(trial.rows, std::move(fit), once);
  compare_fairly(trial);
  trial.price = 2.0 * std::log(tries_of(candidate, trial.effect(), trial.rows.size()));
  trial.comparison.p = std::min(1.0, std::exp(-0.5 * trial.worth()));
  return trial;
}

/// What an effect explains beyond a plainer one that leaves part of the same mark has to be
/// significant by itself, at the price of its search.
bool refutes_plainer(const Contestant& trial) {
  Structure structure = without_last(trial.fit.fit.structure);
  for (const EffectPtr& plainer : trial.effect().plainer()) {
    structure.effects.push_back(plainer);
    const TwinFit fit = twin(trial.rows, polish(trial.rows, structure));
    structure.effects.pop_back();
    const double own = compare(trial.rows, fit, trial.fit).evidence - trial.price;
    if (std::exp(-0.5 * own) > kEnters) return false;
  }
  return true;
}

/// A first look is no more than that for what is found by pv or stands at a limit: by the wrong
/// process it may see nothing of them.
bool called_for(const Round& round, const Effect& effect) {
  const auto* valve = dynamic_cast<const ValveEffect*>(&effect);
  return (valve != nullptr && !valve->by_law_alone()) ||
         (effect.kind() == EffectKind::valve_saturation && round.limits_called_for);
}

/// What was looked at on all rows has shown its worth there.
double least_gain(EffectKind kind) {
  return looked_at_whole(kind) ? kWorthScoring : worth_fitting(kind);
}

/// The error on the fit rows above which an effect of that kind is not worth while.
double hopeless_error(const Contestant& trial, EffectKind kind) {
  const auto rows = static_cast<double>(trial.rows.rows.fit_count());
  return trial.before.fit.fit_error * std::exp(-least_gain(kind) / rows);
}

std::optional<Contestant> try_candidate(const Round& round, const Candidate& candidate) {
  const EffectKind kind = candidate.effect->kind();
  const double worth = worth_fitting(kind);
  if (!called_for(round, *candidate.effect) && candidate.gain < worth) return std::nullopt;
  Contestant trial{{}, {}, judged_on(round.original, candidate.structure), round.now, 0.0};
  if (kind == EffectKind::load_step || kind == EffectKind::gain_change)
    trial.before = reevaluated(trial.rows, round.now);
  const double hopeless = hopeless_error(trial, kind);
  const double far_off = kFarOff * trial.before.fit.fit_error;
  Fit fit = fit_anew(trial.rows, evaluate(trial.rows, candidate.structure), far_off);
  if (!(fit.fit_error <= hopeless) || !is_plausible(fit)) return std::nullopt;
  Contestant entry = finished(std::move(trial), std::move(fit), candidate);
  return entry.enters() && !refutes_plainer(entry) ? std::nullopt : std::optional(std::move(entry));
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

/// Hysteresis leads, or nothing enters without it.
bool asks_for_tracking(const std::vector<Contestant>& entries) {
  return entries.empty() || !entries.front().enters() ||
         is_valve_hysteresis(entries.front().kind());
}

auto hysteresis_among(std::vector<Contestant>& entries) {
  return std::ranges::find_if(
      entries, [](const Contestant& entry) { return is_valve_hysteresis(entry.kind()); });
}

void take_tracked(const Round& round, std::vector<Contestant>& entries) {
  std::optional<Contestant> tracked = best_of(round, find_tracked_valves(round));
  if (!tracked) return;
  const auto alone = hysteresis_among(entries);
  if (alone == entries.end())
    entries.push_back(std::move(*tracked));
  else if (tracked->worth() > alone->worth())
    *alone = std::move(*tracked);
  rank(entries);
}

/// Where a valve's own law has something to show: from nothing a search between the samples led to
/// nothing in 376 loops, and what is far behind another effect comes after it.
bool worth_a_closer_look(const Contestant& valve, const Contestant& leader) {
  constexpr double kFarBehind = 0.3;
  return valve.comparison.evidence > 0.0 &&
         (!leader.enters() || valve.worth() >= kFarBehind * leader.worth());
}

/// The best valve once more, between the samples.
void look_between_samples(const Round& round, std::vector<Contestant>& entries) {
  const auto valve = hysteresis_among(entries);
  if (valve == entries.end() || !worth_a_closer_look(*valve, entries.front())) return;
  std::optional<Fit> fit = sought_between_samples(valve->rows, valve->fit.fit);
  if (!fit) return;
  Contestant trial = finished({{}, {}, valve->rows, round.now, 0.0}, std::move(*fit), {});
  if (trial.worth() <= valve->worth()) return;
  *valve = std::move(trial);
  rank(entries);
}

}  // namespace

void complete(Contestant& winner) {
  if (scored_once(winner.effect())) winner.fit = twin(winner.rows, std::move(winner.fit.fit));
}

std::vector<Contestant> hold_contest(const Round& round) {
  std::vector<Contestant> result;
  for (const std::vector<Candidate>& candidates : find_candidates(round)) {
    std::optional<Contestant> best = best_of(round, candidates);
    if (best) result.push_back(std::move(*best));
  }
  rank(result);
  if (round.tracked_valves && asks_for_tracking(result)) take_tracked(round, result);
  look_between_samples(round, result);
  tell_bends_apart(round.data, result);
  return result;
}

}  // namespace loopscope::core::model
