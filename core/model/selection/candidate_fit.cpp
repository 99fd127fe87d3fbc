#include "core/model/selection/candidate_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/fit/best_wave.hpp"
#include "core/model/fit/fit_variants.hpp"
#include "core/model/fit/trial.hpp"
#include "core/model/valve_search/hysteresis_grid_search.hpp"
#include "core/model/valve_search/stiction_search.hpp"

namespace loopscope::core::model {
namespace {

/// The slip jump is nearly flat in the error until process and noise have followed it: a few of
/// them are followed. The band stays as it is.
Fit scan_jump(const LoopData& data, Fit fit) {
  const ValveEffect* valve = fit.structure.effects.back()->as_valve();
  if (valve == nullptr || !valve->valve().acts_at_samples()) return fit;
  const Fit start = fit;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    Structure structure = start.structure;
    structure.effects.back() = valve->with_jump(share);
    Fit tried = polish(data, structure, 3, fit.fit_error);
    if (tried.fit_error < fit.fit_error) fit = std::move(tried);
  }
  return fit;
}

/// The bands within an eighth of the valve's, with its own jump and a third.
Fit sweep(const LoopData& data, const Structure& start, const ValveEffect& valve, const Fit& best) {
  constexpr double kReach = 0.12, kStep = 0.006, kUsualJump = 1.0 / 3.0;
  const double jump = valve.valve().slip_jump_percent / valve.valve().stickband_percent;
  const FitVariants variants(data, start);
  std::vector<EffectPtr> tried;
  for (double move = -kReach; move <= kReach; move += kStep) {
    for (const double share : {jump, kUsualJump}) {
      tried.push_back(valve.with_band(1.0 + move, share));
    }
  }
  BestVariant found{nullptr, best.fit_error};
  found.take(variants, tried, Digits::single);
  return found.effect ? evaluate(data, with_last(start, found.effect)) : best;
}

/// A law that keeps its errors of position has a needle at the right band: it is swept for, from
/// where the valve begins and from either direction.
Fit scan_band(const LoopData& data, Fit fit) {
  const Structure start = fit.structure;
  const ValveEffect* valve = start.effects.back()->as_valve();
  if (valve == nullptr || !valve->valve().acts_at_samples()) return fit;
  fit = sweep(data, start, *valve, fit);
  for (const double direction : {-1.0, 1.0}) {
    fit = sweep(data, start, valve->coming(direction), fit);
  }
  return fit;
}

/// The search starts from what op alone explains, which a level that moves may hide: the process as
/// it stands is settled too.
Fit searched_and_settled(const LoopData& data, const Fit& fit) {
  Fit searched = search_process(data, fit.structure);
  Fit settled = settle(data, fit);
  return settled.fit_error < searched.fit_error ? std::move(settled) : std::move(searched);
}

/// What a line leaves of a wave whose phase wanders bends the process through itself, and behind
/// that process neither line nor knots explain anything: it is searched behind the changing wave
/// too, with the period that was nominated, since the bent process misplaces it. Together with
/// EffectTraits::fitted_when_asked 162 instead of 158 of 164 waves are named. The last effect of
/// `line` is a wave.
Fit search_behind_wave(const LoopData& data, const Fit& line) {
  constexpr ProcessSearch kShort{.starts = 1};  // two name no more
  Fit fit = searched_and_settled(data, refine_last(data, line));
  const EffectPtr changing = slowly_changing(line.structure.effects.back(), data);
  if (!changing) return fit;
  Fit behind = search_process(data, with_last(line.structure, changing), kShort);
  return misfit_of(behind, data) < misfit_of(fit, data) ? std::move(behind) : std::move(fit);
}

/// Harmonics and knots are added at the end, as long as the process that they leave asks for
/// others.
Fit fit_wave(const LoopData& data, const Fit& line) {
  constexpr int kRounds = 3;
  Fit fit = search_behind_wave(data, line);
  for (int round = 0; round < kRounds; ++round) {
    const EffectPtr now = fit.structure.effects.back();
    const PricedWave wave = best_wave(FitVariants(data, fit.structure), data, now);
    if (wave.effect == now) break;
    fit.structure.effects.back() = wave.effect;
    fit = polish(data, fit.structure, 4);
  }
  return refine_last(data, std::move(fit));
}

/// A jump is claimed only where the data ask for it: play alone is the simpler valve.
Fit prefer_play(const LoopData& data, Fit fit) {
  const ValveEffect* valve = fit.structure.effects.back()->as_valve();
  if (valve == nullptr || valve->kind() == EffectKind::valve_deadband) return fit;
  constexpr double kWorthOfAJump = 8.0;  // n ln: one parameter by BIC
  Structure structure = fit.structure;
  structure.effects.back() = valve->with_jump(0.0);
  Fit play = polish(data, refine_last(data, evaluate(data, structure), 0.5).structure, 3);
  return fit_gain(data, play, fit) < kWorthOfAJump ? std::move(play) : std::move(fit);
}

constexpr std::size_t kMostAhead = 10;
constexpr std::size_t kFewestAhead = 3;
constexpr std::size_t kRowsPerAhead = 200;

std::size_t rows_ahead(const LoopData& rows) {
  return std::clamp(rows.rows.score_count() / kRowsPerAhead, kFewestAhead, kMostAhead);
}

std::vector<double> impulse_response(const NoiseModel& noise, std::size_t count) {
  const auto a = autoregression(noise);
  std::vector<double> psi(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    if (k == 0) psi[k] = 1.0;
    if (k > 0 && k <= kMostNoiseOrder) psi[k] = noise.zeros[k - 1];
    for (std::size_t i = 1; i <= std::min(k, kMostNoiseOrder); ++i) psi[k] -= a[i - 1] * psi[k - i];
  }
  return psi;
}

/// Sum of squares over the held-out rows whose errors are all held out.
double squares_ahead(const std::vector<Range>& held_out, const Fit& fit, std::size_t ahead) {
  const std::vector<double> psi = impulse_response(fit.structure.noise, ahead);
  double sum = 0.0;
  for (const Range& range : held_out) {
    for (std::size_t k = range.first + ahead - 1; k < range.end; ++k) {
      double error = 0.0;
      for (std::size_t j = 0; j < ahead; ++j) error += psi[j] * fit.innovations[k - j];
      sum += error * error;
    }
  }
  return sum;
}

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

Fit fit_candidate(const LoopData& data, Fit fit, double hopeless) {
  const EffectKind kind = fit.structure.effects.back()->kind();
  const bool bends = bends_flow(kind);
  if (!traits_of(kind).moves_on_half) return searched_and_settled(data, fit);
  if (fit.structure.effects.back()->as_wave() != nullptr) return fit_wave(data, fit);
  fit = refine_last(data, std::move(fit));
  // The linear baseline takes all of a valve's travel for dynamics.
  fit = bends ? search_process(data, fit.structure) : settle(data, fit);
  if (is_valve_hysteresis(kind) && fit.fit_error > hopeless) return fit;
  // A valve that has been refined once is near where it ends; limits and places are not always.
  const double coarsest = is_valve_hysteresis(kind) ? 0.25 : 1.0;
  const bool scans = data.without.keeps(Mechanism::bands_scanned);
  if (bends && scans) fit = polish(data, scan_band(data, std::move(fit)).structure, 4);
  if (scans) fit = scan_jump(data, std::move(fit));
  for (int round = 0; bends && round < 3; ++round) {
    const double before = fit.fit_error;
    fit = polish(data, refine_last(data, std::move(fit), coarsest).structure, 4);
    if (fit.fit_error > 0.999 * before) break;
  }
  return prefer_play(data, refine_last(data, std::move(fit), coarsest));
}

double multi_step_evidence(const LoopData& rows, const Fit& before, const Fit& after) {
  const std::size_t ahead = rows_ahead(rows);
  const double ratio =
      squares_ahead(rows.rows.score, before, ahead) / squares_ahead(rows.rows.score, after, ahead);
  const double apart = static_cast<double>(rows.rows.score_count()) / static_cast<double>(ahead);
  return ratio > 0.0 ? apart * std::log(ratio) : 0.0;
}

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
