#include "core/model/contest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/baseline.hpp"

namespace loopscope::core::model {
namespace {

/// An effect that does not gain so much (n ln) where it was fitted gains nothing on unseen rows.
constexpr double kWorthFitting = 8.0;

/// The same by kind: the best of thousands of places or frequencies gains 8 by chance in every
/// loop, and has to reach an evidence of 30 with its tries. Over 376 loops none did from less
/// than 13.5 (a step, scored once) or 10.6 (a line, scored on both halves).
double worth_fitting(EffectKind kind) {
  if (kind == EffectKind::load_step) return 12.0;
  return kind == EffectKind::external_oscillation ? 10.0 : kWorthFitting;
}

/// What it gains is counted once: where it sits (a step) or where pv puts it right (a valve) was
/// taken from the fit rows, so that the mirrored fit has nothing unseen to be scored on.
bool scored_once(EffectKind kind) {
  return kind == EffectKind::load_step || is_valve_hysteresis(kind);
}

/// Found by looking through all places, frequencies or bands on all rows, which count as tries.
bool sought_everywhere(EffectKind kind) {
  return kind == EffectKind::load_step || kind == EffectKind::external_oscillation ||
         is_valve_hysteresis(kind);
}

TwinFit reevaluated(const LoopData& rows, const TwinFit& fit) {
  return {evaluate(rows, fit.fit.structure), evaluate(mirrored(rows), fit.mirror.structure)};
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
  const bool once = scored_once(trial.kind());
  trial.comparison = compare(trial.rows, trial.before, trial.fit, once);
  if (trial.comparison.evidence <= 0.0) return;
  const TwinFit bare =
      scored_fit(trial.rows, polish(trial.rows, without_last(trial.fit.fit.structure)), once);
  const Comparison fair = compare(trial.rows, bare, trial.fit, once);
  if (fair.evidence >= trial.comparison.evidence) return;
  trial.comparison = fair;
  trial.before = bare;
}

Contestant finished(const Round& round, Contestant trial, Fit fit) {
  const bool once = scored_once(fit.structure.effects.back()->kind());
  trial.fit = scored_fit(trial.rows, std::move(fit), once);
  compare_fairly(trial);
  if (sought_everywhere(trial.kind())) {
    trial.comparison.p = std::min(1.0, trial.comparison.p * static_cast<double>(round.data.size()));
  }
  return trial;
}

/// The best valve once more by the other laws, where its own has anything to show: from nothing
/// they led to nothing in 376 loops.
void try_other_laws(const Round& round, std::optional<Contestant>& best) {
  if (!best || !is_valve_hysteresis(best->kind()) || best->comparison.evidence <= 0.0) return;
  Fit fit = cross_laws(best->rows, best->fit.fit);
  if (fit.fit_error >= best->fit.fit.fit_error) return;
  Contestant trial = finished(round, {{}, {}, best->rows, best->before}, std::move(fit));
  if (trial.comparison.evidence > best->comparison.evidence) best = std::move(trial);
}

/// A first look is no more than that for effects that bend op: by the wrong process it may see
/// nothing of them.
bool called_for(const Round& round, EffectKind kind) {
  return is_valve_hysteresis(kind)
             ? round.valves_called_for
             : kind == EffectKind::valve_saturation && round.limits_called_for;
}

/// The error on the fit rows above which an effect of that kind is not worth while.
double hopeless_error(const Contestant& trial, EffectKind kind) {
  const auto rows = static_cast<double>(trial.rows.rows.fit_count());
  return trial.before.fit.fit_error * std::exp(-worth_fitting(kind) / rows);
}

std::optional<Contestant> try_candidate(const Round& round, const Candidate& candidate) {
  const EffectKind kind = candidate.effect->kind();
  if (!called_for(round, kind) && candidate.gain < worth_fitting(kind)) return std::nullopt;
  Contestant trial{{}, {}, judged_on(round.original, candidate.structure), round.now};
  if (kind == EffectKind::load_step) trial.before = reevaluated(trial.rows, round.now);
  const double hopeless = hopeless_error(trial, kind);
  Fit fit = fit_anew(trial.rows, evaluate(trial.rows, candidate.structure), hopeless);
  if (fit.fit_error > hopeless) return std::nullopt;
  return finished(round, std::move(trial), std::move(fit));
}

}  // namespace

void complete(Contestant& winner) {
  if (scored_once(winner.kind())) winner.fit = twin(winner.rows, std::move(winner.fit.fit));
}

std::vector<Contestant> hold_contest(const Round& round) {
  std::vector<Contestant> result;
  for (const std::vector<Candidate>& candidates : find_candidates(round)) {
    std::optional<Contestant> best;
    for (const Candidate& candidate : candidates) {
      std::optional<Contestant> entry = try_candidate(round, candidate);
      if (entry && (!best || entry->comparison.evidence > best->comparison.evidence))
        best = std::move(entry);
    }
    try_other_laws(round, best);
    if (best) result.push_back(std::move(*best));
  }
  std::ranges::sort(result, std::greater{},
                    [](const Contestant& entry) { return entry.comparison.evidence; });
  return result;
}

}  // namespace loopscope::core::model
