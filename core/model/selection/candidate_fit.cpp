#include "core/model/selection/candidate_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/selection/multi_step_error.hpp"
#include "core/model/valve_search/hysteresis_grid_search.hpp"
#include "core/model/valve_search/stiction_search.hpp"

namespace loopscope::core::model {
namespace {

/// What a valve was chosen from shows when it has been fitted: play is smooth in its band, and only
/// so many bands differ.
double tries_of(const Effect& fitted, std::size_t tries, std::size_t samples) {
  const ValveEffect* valve = fitted.as_valve();
  if (valve == nullptr) return static_cast<double>(std::max<std::size_t>(tries, 1));
  const bool play = valve->valve().slip_jump_percent == 0.0;
  if (play && valve->valve().acts_at_samples()) return static_cast<double>(hysteresis_net_bands());
  return static_cast<double>(valve->valve().acts_at_samples() ? samples : kStemGuesses);
}

/// The fit to the other fold of what is scored once waits until it has won: nothing is read from it
/// before.
CrossFit scored_fit(const LoopData& rows, Fit fit, bool once) {
  if (once) return {std::move(fit), {}};
  return cross_fit(rows, std::move(fit));
}

/// A trial searches the process again, and may leave a local optimum that the model without the
/// effect sits in. What that gains is not the effect's: it is compared with the better of both.
void compare_fairly(CandidateFit& trial) {
  const bool once = trial.scored_once();
  trial.comparison = compare(trial.rows, trial.before, trial.fit, once);
  if (!trial.rows.without.keeps(Mechanism::fair_comparison)) return;
  if (trial.comparison.evidence <= 0.0) return;
  const CrossFit bare =
      scored_fit(trial.rows, polish(trial.rows, without_last(trial.fit.fit.structure)), once);
  const Comparison fair = compare(trial.rows, bare, trial.fit, once);
  if (fair.evidence >= trial.comparison.evidence) return;
  trial.comparison = fair;
  trial.before = bare;
}

}  // namespace

bool CandidateFit::scored_once() const {
  return traits_of(kind()).scored_once;
}

CandidateFit scored(CandidateFit trial, Fit fit, std::size_t tries) {
  trial.fit.fit = std::move(fit);
  const bool once = trial.scored_once();
  trial.fit = scored_fit(trial.rows, std::move(trial.fit.fit), once);
  compare_fairly(trial);
  trial.price = 2.0 * std::log(tries_of(trial.effect(), tries, trial.rows.size()));
  trial.comparison.p = std::min(1.0, std::exp(-0.5 * trial.worth()));
  return trial;
}

bool foresees(const CandidateFit& trial) {
  if (is_from_outside(trial.kind())) return true;
  if (!trial.rows.without.keeps(Mechanism::multi_step)) return true;
  const double evidence = multi_step_evidence(trial.rows, trial.before.fit, trial.fit.fit);
  return std::exp(-0.5 * evidence) <= kEnters;
}

bool refutes_plainer(const CandidateFit& trial) {
  Structure structure = without_last(trial.fit.fit.structure);
  for (const EffectPtr& plainer : trial.effect().plainer()) {
    structure.effects.push_back(plainer);
    const CrossFit fit = cross_fit(trial.rows, polish(trial.rows, structure));
    structure.effects.pop_back();
    const double own = compare(trial.rows, fit, trial.fit).evidence - trial.price;
    if (std::exp(-0.5 * own) > kEnters) return false;
  }
  return true;
}

void complete(CandidateFit& winner) {
  if (winner.scored_once()) winner.fit = cross_fit(winner.rows, std::move(winner.fit.fit));
}

}  // namespace loopscope::core::model
