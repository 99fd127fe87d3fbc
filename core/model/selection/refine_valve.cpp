#include "core/model/selection/refine_valve.hpp"

#include <utility>

#include "core/model/effects/valve.hpp"
#include "core/model/selection/fit_candidate.hpp"
#include "core/model/valve_search/stiction_search.hpp"

namespace loopscope::core::model {
namespace {

GridResult best_stem(const LoopData& rows, const Structure& behind, std::size_t attempt) {
  const Valve& valve = behind.effects.back()->as_valve()->valve();
  const auto by = [&](ValveLaw law) {
    return find_stem(rows, behind, valve.stickband_percent, law, attempt);
  };
  if (!valve.acts_at_samples()) return by(valve.law);
  GridResult he = by(ValveLaw::he);
  GridResult kano = by(ValveLaw::kano);
  return kano.fit_error < he.fit_error ? std::move(kano) : std::move(he);
}

}  // namespace

std::optional<CandidateFit> refine_valve(const CandidateFit& entered, const Fit& settled,
                                         std::size_t attempt) {
  if (!entered.rows.without.keeps(Mechanism::stem_search) || !can_seek_sticking(settled.structure))
    return std::nullopt;
  const GridResult find = best_stem(entered.rows, settled.structure, attempt);
  if (!(find.fit_error < settled.fit_error)) return std::nullopt;
  Fit fit = fit_candidate(entered.rows, evaluate(entered.rows, find.structure));
  CandidateFit closer =
      scored({{}, {}, entered.rows, entered.before, 0.0}, std::move(fit), kStemGuesses);
  return closer.worth() > entered.worth() ? std::optional(std::move(closer)) : std::nullopt;
}

}  // namespace loopscope::core::model
