#include "core/model/selection/fit_candidate.hpp"

#include <utility>
#include <vector>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/fit/best_wave.hpp"
#include "core/model/fit/fit_variants.hpp"
#include "core/model/fit/trial.hpp"

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
  const bool scans = data.without.keeps(Mechanism::bands_scanned);
  if (bends && scans) fit = polish(data, scan_band(data, std::move(fit)).structure, 4);
  if (scans) fit = scan_jump(data, std::move(fit));
  for (int round = 0; bends && round < 3; ++round) {
    const double before = fit.fit_error;
    fit = polish(data, refine_last(data, std::move(fit)).structure, 4);
    if (fit.fit_error > 0.999 * before) break;
  }
  return prefer_play(data, refine_last(data, std::move(fit)));
}

}  // namespace loopscope::core::model
