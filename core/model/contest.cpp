#include "core/model/contest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/tell_bends_apart.hpp"

namespace loopscope::core::model {
namespace {

/// An effect that does not gain so much (n ln) where it was fitted gains nothing on unseen rows.
constexpr double kWorthFitting = 8.0;
/// The same where all rows are looked at: less than what a later p of 0.001 asks for.
constexpr double kWorthFittingWhole = 11.0;
/// On the fit rows, of an effect that has shown so much on all: about its parameters.
constexpr double kWorthScoring = 3.0;
/// What it gains is counted once: where it sits (a step) or where pv puts it right (a valve) was
/// taken from the fit rows, so that the mirrored fit has nothing unseen to be scored on.
bool scored_once(EffectKind kind) {
  return kind == EffectKind::load_step || is_valve_hysteresis(kind);
}

TwinFit reevaluated(const LoopData& rows, const TwinFit& fit) {
  return {evaluate(rows, fit.fit.structure), evaluate(mirrored(rows), fit.mirror.structure)};
}

Structure without_last(Structure structure) {
  structure.effects.pop_back();
  return structure;
}

/// A trial searches the process again, and may leave a local optimum that the model without the
/// effect sits in. What that gains is not the effect's: it is compared with the better of both.
void compare_fairly(Contestant& trial) {
  const bool once = scored_once(trial.kind());
  trial.comparison = compare(trial.rows, trial.before, trial.fit, once);
  const TwinFit bare = twin(trial.rows, polish(trial.rows, without_last(trial.fit.fit.structure)));
  const Comparison fair = compare(trial.rows, bare, trial.fit, once);
  if (fair.evidence >= trial.comparison.evidence) return;
  trial.comparison = fair;
  trial.before = bare;
}

Contestant finished(Contestant trial, Fit fit) {
  trial.fit = twin(trial.rows, std::move(fit));
  compare_fairly(trial);
  trial.comparison.p = std::min(1.0, std::exp(-0.5 * trial.worth()));
  return trial;
}

/// The best valve once more by the other laws.
void try_other_laws(std::optional<Contestant>& best) {
  if (!best || !is_valve_hysteresis(best->kind())) return;
  Fit fit = cross_laws(best->rows, best->fit.fit);
  if (fit.fit_error >= best->fit.fit.fit_error) return;
  Contestant trial = finished({{}, {}, best->rows, best->before, best->price}, std::move(fit));
  if (trial.comparison.evidence > best->comparison.evidence) best = std::move(trial);
}

/// What was looked at on all rows has shown its worth there.
double least_gain(EffectKind kind) {
  return looked_at_whole(kind) ? kWorthScoring : kWorthFitting;
}

std::optional<Contestant> try_candidate(const Round& round, const Candidate& candidate) {
  const EffectKind kind = candidate.effect->kind();
  const bool called_for = is_valve_hysteresis(kind) ||
                          (kind == EffectKind::valve_saturation && round.limits_called_for);
  const double worth_fitting = looked_at_whole(kind) ? kWorthFittingWhole : kWorthFitting;
  if (!called_for && candidate.gain < worth_fitting) return std::nullopt;
  Contestant trial{{},
                   {},
                   judged_on(round.original, candidate.structure),
                   round.now,
                   2.0 * std::log(static_cast<double>(candidate.tries))};
  if (kind == EffectKind::load_step) trial.before = reevaluated(trial.rows, round.now);
  Fit fit = fit_anew(trial.rows, evaluate(trial.rows, candidate.structure));
  if (fit_gain(trial.rows, trial.before.fit, fit) < least_gain(kind)) return std::nullopt;
  return finished(std::move(trial), std::move(fit));
}

}  // namespace

std::vector<Contestant> hold_contest(const Round& round) {
  std::vector<Contestant> result;
  for (const std::vector<Candidate>& candidates : find_candidates(round)) {
    std::optional<Contestant> best;
    for (const Candidate& candidate : candidates) {
      std::optional<Contestant> entry = try_candidate(round, candidate);
      if (entry && (!best || entry->comparison.evidence > best->comparison.evidence))
        best = std::move(entry);
    }
    try_other_laws(best);
    if (best) result.push_back(std::move(*best));
  }
  std::ranges::sort(result, std::greater{}, [](const Contestant& entry) { return entry.worth(); });
  tell_bends_apart(round.data, result);
  return result;
}

}  // namespace loopscope::core::model
