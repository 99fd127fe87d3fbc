#include "core/model/fit/best_wave.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "core/model/effects/external_oscillation.hpp"

namespace loopscope::core::model {
namespace {

const ExternalOscillation& as_wave(const EffectPtr& effect) {
  return *effect->as_wave();
}

double rows_of(const LoopData& data) {
  return static_cast<double>(data.rows.fit_count());
}

/// BIC for a harmonic: it is there or not, and a false one may turn a line into half its frequency.
/// A column more for the course of what is there lowers the error by one, by chance, where it is
/// fitted, and raises it by one elsewhere; 3 for the choice among the nets. Prices of 2 to 3
/// explain alike, 4 finds one wave in twenty less.
double price_of(const ExternalOscillation& wave, double rows) {
  constexpr double kPriceOfAKnot = 3.0;
  const auto constant = static_cast<double>(2 * wave.harmonics());
  const auto all = static_cast<double>(wave.column_count());
  return (constant - 2.0) * std::log(rows) + (all - constant) * kPriceOfAKnot;
}

double misfit(double error, double rows, const EffectPtr& wave) {
  return rows * std::log(error) + price_of(as_wave(wave), rows);
}

PricedWave priced(const FitVariants& variants, double rows, const EffectPtr& wave) {
  return {wave, misfit(variants.fit_error(wave), rows, wave)};
}

double added_columns(const PricedWave& few, const PricedWave& many) {
  return static_cast<double>(many.effect->column_count()) -
         static_cast<double>(few.effect->column_count());
}

/// Whether one of them is better than the best, which it then is. The best may be among them.
bool take_best(const FitVariants& variants, double rows, const std::vector<EffectPtr>& waves,
               PricedWave& best) {
  bool better = false;
  for (const EffectPtr& wave : waves) {
    if (as_wave(wave) == as_wave(best.effect)) continue;
    PricedWave tried = priced(variants, rows, wave);
    if (!(tried.misfit < best.misfit)) continue;
    best = std::move(tried);
    better = true;
  }
  return better;
}

/// The same for nets of knots, from coarse to fine: where the columns that a net adds leave so much
/// of their price unearned, finer nets are not looked at. Of 280 searches none lost its net by that
/// and more than half of all columns were spared.
void take_best_net(const FitVariants& variants, double rows, const std::vector<EffectPtr>& nets,
                   PricedWave& best) {
  constexpr double kUnearned = 1.0;  // of 3 a column, where chance leaves 2
  std::optional<PricedWave> coarser;
  for (const EffectPtr& net : nets) {
    PricedWave tried = as_wave(net) == as_wave(best.effect) ? best : priced(variants, rows, net);
    if (tried.misfit < best.misfit) best = tried;
    if (coarser && tried.misfit - coarser->misfit > kUnearned * added_columns(*coarser, tried))
      return;
    coarser = std::move(tried);
  }
}

}  // namespace

double misfit_of(const Fit& fit, const LoopData& data) {
  return misfit(fit.fit_error, rows_of(data), fit.structure.effects.back());
}

EffectPtr slowly_changing(const EffectPtr& line, const LoopData& data) {
  constexpr std::size_t kNet = 2;  // eight stretches: the line itself comes first
  if (!data.without.keeps(Mechanism::wave_shape)) return nullptr;
  const std::vector<EffectPtr> nets =
      as_wave(line).with_knots(data.samples(), data.grid.samples_per_row);
  return nets.size() > kNet ? nets[kNet] : nullptr;
}

PricedWave best_wave(const FitVariants& variants, const LoopData& data, const EffectPtr& start) {
  constexpr int kTurns = 3;
  const double rows = rows_of(data);
  PricedWave best = priced(variants, rows, start);
  if (!data.without.keeps(Mechanism::wave_shape)) return best;
  for (int turn = 0; turn < kTurns; ++turn) {
    take_best_net(variants, rows,
                  as_wave(best.effect).with_knots(data.samples(), data.grid.samples_per_row), best);
    if (!take_best(variants, rows, as_wave(best.effect).with_harmonics(), best)) break;
  }
  return best;
}

PricedWave first_look_at_wave(const FitVariants& variants, const LoopData& data,
                              const EffectPtr& line) {
  const double rows = rows_of(data);
  PricedWave best = priced(variants, rows, line);
  const EffectPtr changing = slowly_changing(line, data);
  if (changing) take_best(variants, rows, {changing}, best);
  return best;
}

}  // namespace loopscope::core::model
