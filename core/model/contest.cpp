#include "core/model/contest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/hysteresis_net.hpp"

namespace loopscope::core::model {
namespace {

/// An effect that does not gain so much (n ln) where it was fitted gains nothing on unseen rows.
constexpr double kWorthFitting = 8.0;
/// What it gains is counted once: where it sits (a step) or where pv puts it right (a valve) was
/// taken from the fit rows, so that the mirrored fit has nothing unseen to be scored on.
bool scored_once(const Effect& effect) {
  const auto* valve = dynamic_cast<const ValveEffect*>(&effect);
  return effect.kind() == EffectKind::load_step || (valve != nullptr && !valve->by_law_alone());
}

/// Found by looking through places, frequencies or bands on all rows, each of which is a try. Play
/// is smooth in its band: only so many bands differ.
double tries_of(const Effect& effect, std::size_t samples) {
  const bool everywhere = effect.kind() == EffectKind::load_step ||
                          effect.kind() == EffectKind::external_oscillation ||
                          is_valve_hysteresis(effect.kind());
  const auto* valve = dynamic_cast<const ValveEffect*>(&effect);
  if (valve != nullptr && valve->by_law_alone() && valve->valve().slip_jump_percent == 0.0)
    return static_cast<double>(hysteresis_net_bands());
  return everywhere ? static_cast<double>(samples) : 1.0;
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
  const bool once = scored_once(trial.effect());
  trial.comparison = compare(trial.rows, trial.before, trial.fit, once);
  const TwinFit bare = twin(trial.rows, polish(trial.rows, without_last(trial.fit.fit.structure)));
  const Comparison fair = compare(trial.rows, bare, trial.fit, once);
  if (fair.evidence >= trial.comparison.evidence) return;
  trial.comparison = fair;
  trial.before = bare;
}

Contestant finished(const Round& round, Contestant trial, Fit fit) {
  trial.fit = twin(trial.rows, std::move(fit));
  compare_fairly(trial);
  const double tries = tries_of(trial.effect(), round.data.size());
  trial.price = 2.0 * std::log(tries);
  trial.comparison.p = std::min(1.0, trial.comparison.p * tries);
  return trial;
}

/// The best valve once more by the other laws.
void try_other_laws(const Round& round, std::optional<Contestant>& best) {
  if (!best || !is_valve_hysteresis(best->kind())) return;
  std::optional<Fit> fit = cross_laws(best->rows, best->fit.fit);
  if (!fit) return;
  Contestant trial = finished(round, {{}, {}, best->rows, best->before, 0.0}, std::move(*fit));
  if (trial.worth() > best->worth()) best = std::move(trial);
}

std::optional<Contestant> try_candidate(const Round& round, const Candidate& candidate) {
  const EffectKind kind = candidate.effect->kind();
  const bool called_for = (is_valve_hysteresis(kind) && round.hysteresis_called_for) ||
                          (kind == EffectKind::valve_saturation && round.limits_called_for);
  if (!called_for && candidate.gain < kWorthFitting) return std::nullopt;
  Contestant trial{{}, {}, judged_on(round.original, candidate.fit.structure), round.now, 0.0};
  if (candidate.effect->kind() == EffectKind::load_step)
    trial.before = reevaluated(trial.rows, round.now);
  Fit fit = fit_anew(trial.rows, candidate.fit);
  if (fit_gain(trial.rows, trial.before.fit, fit) < kWorthFitting) return std::nullopt;
  return finished(round, std::move(trial), std::move(fit));
}

}  // namespace

std::vector<Contestant> hold_contest(const Round& round) {
  std::vector<Contestant> result;
  for (const std::vector<Candidate>& candidates : find_candidates(round)) {
    std::optional<Contestant> best;
    for (const Candidate& candidate : candidates) {
      std::optional<Contestant> entry = try_candidate(round, candidate);
      if (entry && (!best || entry->worth() > best->worth())) best = std::move(entry);
    }
    try_other_laws(round, best);
    if (best) result.push_back(std::move(*best));
  }
  std::ranges::sort(result, std::greater{}, &Contestant::worth);
  return result;
}

}  // namespace loopscope::core::model
