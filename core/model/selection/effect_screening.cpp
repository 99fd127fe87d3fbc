#include "core/model/selection/effect_screening.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/fit/best_wave.hpp"
#include "core/model/fit/trial.hpp"

namespace loopscope::core::model {
namespace {

/// A sudden step is seen by fit and score over so many rows from so many before it on: about as
/// far as its place moves while it is fitted. A place whose first sample the fit does not see
/// leaves one of its coefficients free.
constexpr std::size_t kStepBefore = 12;
constexpr std::size_t kStepSamples = 40;

}  // namespace

LoopData judged_on(const LoopData& original, const Structure& structure) {
  LoopData data = original;
  for (const EffectPtr& effect : structure.effects) {
    const std::optional<std::size_t> at = effect->moment();
    if (!at) continue;
    const std::size_t row = data.grid.row_from(*at);
    const std::size_t from = row < kStepBefore ? 0 : row - kStepBefore;
    data.rows = seen_by_both(data.rows, from, kStepSamples);
  }
  return data;
}

EffectScreening::View EffectScreening::whole_view(const Round& round) {
  View view{seen_whole(round.data), 0.0};
  view.before = evaluate(view.rows, round.now.fit.structure).fit_error;
  return view;
}

EffectScreening::EffectScreening(const Round& round)
    : round_(round), part_{round.data, round.now.fit.fit_error}, whole_(whole_view(round)) {}

Candidate EffectScreening::at(const EffectPtr& effect) {
  if (bends_flow(effect->kind())) return through(effect);
  return traits_of(effect->kind()).scored_once ? at_step(effect) : beside(effect);
}

Candidate EffectScreening::through(const EffectPtr& effect) const {
  const View& view = traits_of(effect->kind()).looked_at_whole ? whole_ : part_;
  Structure structure = with(round_.now.fit.structure, effect);
  structure.process = glance(view.rows, structure);
  structure.two_taps = false;
  structure.second_order = false;
  const double error = evaluate(view.rows, structure).fit_error;
  return {effect, std::move(structure), gain_of(view.rows, view.before, error)};
}

void EffectScreening::put_in_place(Candidate& candidate) const {
  const LoopData rows = seen_whole(judged_on(round_.original, candidate.structure));
  const Fit fit = refine_last(rows, evaluate(rows, candidate.structure));
  const double before = evaluate(rows, round_.now.fit.structure).fit_error;
  candidate.structure = fit.structure;
  candidate.effect = fit.structure.effects.back();
  candidate.gain = gain_of(rows, before, fit.fit_error);
}

/// A load step brings rows of its own.
Candidate EffectScreening::at_step(const EffectPtr& effect) const {
  Structure structure = with(round_.now.fit.structure, effect);
  const LoopData rows = judged_on(round_.original, structure);
  const double before = evaluate(rows, round_.now.fit.structure).fit_error;
  const double after = evaluate(rows, structure).fit_error;
  return {effect, std::move(structure), gain_of(rows, before, after)};
}

/// An effect that leaves the flow and the rows as they are.
Candidate EffectScreening::beside(const EffectPtr& effect) {
  const bool all = traits_of(effect->kind()).looked_at_whole;
  const View& view = all ? whole_ : part_;
  std::optional<FitVariants>& variants = all ? whole_variants_ : part_variants_;
  Structure structure = with(round_.now.fit.structure, effect);
  if (!variants) variants.emplace(view.rows, structure);
  if (effect->as_wave() != nullptr) {
    const double misfit = first_look_at_wave(*variants, view.rows, effect).misfit;
    const auto rows = static_cast<double>(view.rows.rows.fit_count());
    return {effect, std::move(structure), gain_of(view.rows, view.before, std::exp(misfit / rows))};
  }
  const double error = variants->fit_error(effect);
  return {effect, std::move(structure), gain_of(view.rows, view.before, error)};
}

}  // namespace loopscope::core::model
