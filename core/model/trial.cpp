#include "core/model/trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/model/baseline.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit_variants.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kParts = 8;

double sum_of_squares(const std::vector<double>& values, const Range& range) {
  double sum = 0.0;
  for (std::size_t k = range.first; k < range.end; ++k) sum += values[k] * values[k];
  return sum;
}

struct Sums {
  double before = 0.0, after = 0.0;
  std::size_t rows = 0;
  std::array<double, kParts> part_before{}, part_after{};
};

void add_up(const LoopData& data, const std::vector<Range>& rows, const Fit& before,
            const Fit& after, Sums& sums) {
  for (const Range& range : rows) {
    const double a = sum_of_squares(before.innovations, range);
    const double b = sum_of_squares(after.innovations, range);
    const std::size_t part = std::min(kParts - 1, range.first * kParts / data.size());
    sums.before += a;
    sums.after += b;
    sums.part_before[part] += a;
    sums.part_after[part] += b;
    sums.rows += range.size();
  }
}

/// Of an error: two laws that move the same valve alike are a tie, which the first one keeps.
constexpr double kRounding = 1e-9;

/// The best last effect of the variants that were looked at.
struct Found {
  EffectPtr effect;
  double error;

  bool take(const FitVariants& variants, const EffectPtr& tried) {
    const double tried_error = variants.fit_error(tried);
    if (tried_error >= (1.0 - kRounding) * error) return false;
    *this = {tried, tried_error};
    return true;
  }
};

Fit evaluated_with(const LoopData& data, Structure structure, const EffectPtr& last) {
  structure.effects.back() = last;
  return evaluate(data, structure);
}

/// The moves of op right after a gain has changed lie in one half only: the other half would shift
/// the change to behind them. Its place is found on all rows (candidates.hpp).
bool moves_on_half(const Effect& effect) {
  return effect.kind() != EffectKind::gain_change;
}

}  // namespace

TwinFit twin(const LoopData& data, Fit fit) {
  const LoopData other = mirrored(data);
  Fit mirror = polish(other, fit.structure, 4);
  // A valve's band is a needle: the half that it is scored on stands for the tries of its search.
  const Effect* last = fit.structure.effects.empty() ? nullptr : fit.structure.effects.back().get();
  if (last != nullptr && !is_valve_hysteresis(last->kind()) && moves_on_half(*last))
    mirror = refine_last(other, std::move(mirror), 0.25);
  return {std::move(fit), std::move(mirror)};
}

Comparison compare(const LoopData& data, const TwinFit& before, const TwinFit& after, bool once) {
  Sums sums;
  add_up(data, data.rows.score, before.fit, after.fit, sums);
  if (!once) add_up(data, data.rows.fit, before.mirror, after.mirror, sums);
  Comparison result;
  if (sums.rows == 0 || sums.after <= 0.0) return result;
  const auto n = static_cast<double>(sums.rows);
  result.before = sums.before / n;
  result.after = sums.after / n;
  result.evidence = n * std::log(result.before / result.after);
  result.p = std::min(1.0, std::exp(-0.5 * result.evidence));
  for (std::size_t part = 0; part < kParts; ++part) {
    result.steadiness += sums.part_after[part] < sums.part_before[part] ? 1.0 / kParts : 0.0;
  }
  return result;
}

TwinFit reevaluated(const LoopData& rows, const TwinFit& fit) {
  return {evaluate(rows, fit.fit.structure), evaluate(mirrored(rows), fit.mirror.structure)};
}

bool is_plausible(const Fit& fit) {
  const std::size_t last = fit.structure.effects.size() - 1;
  return fit.structure.effects[last]->plausible(coefficients_of(fit, last), fit.gain());
}

double fit_gain(const LoopData& data, const Fit& before, const Fit& after) {
  return static_cast<double>(data.rows.fit_count()) * std::log(before.fit_error / after.fit_error);
}

Fit refine_last(const LoopData& data, Fit fit, double coarsest) {
  constexpr int kRounds = 3;
  const EffectPtr first = fit.structure.effects.back();
  if (first->neighbours(coarsest).empty()) return fit;
  const FitVariants variants(data, fit.structure);
  Found best{first, variants.fit_error(first)};
  for (double scale = coarsest; scale > 0.05; scale *= 0.5) {
    bool improved = true;
    for (int round = 0; round < kRounds && improved; ++round) {
      improved = false;
      for (const EffectPtr& effect : best.effect->neighbours(scale)) {
        improved = best.take(variants, effect) || improved;
      }
    }
  }
  return best.effect == first ? std::move(fit) : evaluated_with(data, fit.structure, best.effect);
}

namespace {

/// The slip jump is nearly flat in the error until process and noise have followed it: a few of
/// them are followed. Restarts and band stay as they are.
Fit scan_jump(const LoopData& data, Fit fit) {
  const auto* valve = dynamic_cast<const ValveEffect*>(fit.structure.effects.back().get());
  if (valve == nullptr) return fit;
  const Fit start = fit;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    Structure structure = start.structure;
    structure.effects.back() = valve->with_jump(share);
    Fit tried = polish(data, structure, 3);
    if (tried.fit_error < fit.fit_error) fit = std::move(tried);
  }
  return fit;
}

/// The bands within an eighth of the valve's, with its own jump and a third.
Fit sweep(const LoopData& data, const Structure& start, const ValveEffect& valve, Fit best) {
  constexpr double kReach = 0.12, kStep = 0.006, kUsualJump = 1.0 / 3.0;
  const double jump = valve.valve().slip_jump_percent / valve.valve().stickband_percent;
  const FitVariants variants(data, start);
  Found found{nullptr, best.fit_error};
  for (double move = -kReach; move <= kReach; move += kStep) {
    for (const double share : {jump, kUsualJump}) {
      found.take(variants, valve.with_band(1.0 + move, share));
    }
  }
  return found.effect ? evaluated_with(data, start, found.effect) : best;
}

/// A law that keeps its errors of position has a needle at the right band, which a search that puts
/// positions right passes by: it is swept for with the corrections of the search, and without.
Fit scan_band(const LoopData& data, Fit fit) {
  const Structure start = fit.structure;
  const auto* valve = dynamic_cast<const ValveEffect*>(start.effects.back().get());
  if (valve == nullptr) return fit;
  fit = sweep(data, start, *valve, std::move(fit));
  for (const double direction : {-1.0, 1.0}) {
    fit = sweep(data, start, *valve->by_law_alone(direction), std::move(fit));
  }
  return fit;
}

/// A jump is claimed only where the data ask for it: play alone is the simpler valve.
Fit prefer_play(const LoopData& data, Fit fit) {
  const auto* valve = dynamic_cast<const ValveEffect*>(fit.structure.effects.back().get());
  if (valve == nullptr || valve->kind() == EffectKind::valve_deadband) return fit;
  constexpr double kWorthOfAJump = 8.0;  // n ln: one parameter by BIC
  Structure structure = fit.structure;
  structure.effects.back() = valve->with_jump(0.0);
  Fit play = polish(data, refine_last(data, evaluate(data, structure), 0.5).structure, 3);
  return fit_gain(data, play, fit) < kWorthOfAJump ? std::move(play) : std::move(fit);
}

}  // namespace

namespace {

/// Slips on every rung: a law that jumps to where op is, or play, shows about where the band is and
/// little of the jump.
Fit sweep_gradual(const LoopData& data, const Structure& start, const ValveEffect& valve,
                  Fit best) {
  constexpr double kReach = 0.24, kStep = 0.03;
  const FitVariants variants(data, start);
  Found found{nullptr, best.fit_error};
  for (double move = -kReach; move <= kReach; move += kStep) {
    const double band = valve.valve().stickband_percent * (1.0 + move);
    for (const double share : {0.25, 0.4, 0.55, 0.7, 0.85, 1.0}) {
      for (const EffectPtr& rung : ValveEffect::on_every_rung(band, share * band, data.op.front()))
        found.take(variants, rung);
    }
  }
  return found.effect ? evaluated_with(data, start, found.effect) : best;
}

}  // namespace

std::optional<Fit> cross_laws(const LoopData& data, const Fit& fit) {
  const Structure& start = fit.structure;
  const auto* valve = dynamic_cast<const ValveEffect*>(start.effects.back().get());
  if (valve == nullptr) return std::nullopt;
  // What puts a valve right flatters its fit: against such a one any law by itself is worth a look.
  Fit best = fit;
  if (!valve->by_law_alone()) best.fit_error = std::numeric_limits<double>::infinity();
  const double to_beat = best.fit_error;
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he}) {
    if (law == valve->valve().law && valve->by_law_alone()) continue;
    for (const double direction : {-1.0, 1.0}) {
      best = sweep(data, start, *valve->with_law(law)->by_law_alone(direction), std::move(best));
    }
  }
  best = sweep_gradual(data, start, *valve, std::move(best));
  if (best.fit_error >= to_beat) return std::nullopt;
  return fit_anew(data, std::move(best));
}

Fit fit_anew(const LoopData& data, Fit fit, double hopeless) {
  const EffectKind kind = fit.structure.effects.back()->kind();
  const bool bends = bends_flow(kind);
  if (!moves_on_half(*fit.structure.effects.back())) return search_process(data, fit.structure);
  fit = refine_last(data, std::move(fit));
  // The linear baseline takes part of an oscillation, and all of a valve's travel, for dynamics.
  fit = bends || kind == EffectKind::external_oscillation ? search_process(data, fit.structure)
                                                          : settle(data, fit);
  if (is_valve_hysteresis(kind) && fit.fit_error > hopeless) return fit;
  if (bends) fit = polish(data, scan_band(data, std::move(fit)).structure, 4);
  fit = scan_jump(data, std::move(fit));
  for (int round = 0; bends && round < 3; ++round) {
    const double before = fit.fit_error;
    fit = polish(data, refine_last(data, std::move(fit)).structure, 4);
    if (fit.fit_error > 0.999 * before) break;
  }
  return prefer_play(data, refine_last(data, std::move(fit)));
}

}  // namespace loopscope::core::model
