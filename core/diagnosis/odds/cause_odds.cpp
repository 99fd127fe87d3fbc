#include "core/diagnosis/odds/cause_odds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/diagnosis/evidence/figure.hpp"
#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/odds/cause_curves.hpp"
#include "core/diagnosis/odds/log_odds.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Curves with the places of their figures.
struct PlacedCause {
  const CauseCurves* curves = nullptr;
  VerdictCode code = VerdictCode::healthy;
  std::vector<std::size_t> figures;
};

std::vector<PlacedCause> place(const std::vector<CauseCurves>& table) {
  std::vector<PlacedCause> placed;
  for (const CauseCurves& curves : table) {
    PlacedCause cause{&curves, verdict_code(curves.cause).value(), {}};
    for (const FigureCurve& curve : curves.curves)
      cause.figures.push_back(figure_place(curve.figure).value());
    placed.push_back(std::move(cause));
  }
  return placed;
}

const std::vector<PlacedCause>& placed_table(bool with_model) {
  static const std::vector<PlacedCause> with = place(fitted_curves(true));
  static const std::vector<PlacedCause> without = place(fitted_curves(false));
  return with_model ? with : without;
}

/// 0 = as in the fit.
double prior_of(VerdictCode code, const Priors& priors) {
  switch (code) {
    case VerdictCode::healthy:
      return priors.healthy;
    case VerdictCode::valve_stiction:
      return priors.valve_stiction;
    case VerdictCode::valve_deadband:
      return priors.valve_deadband;
    case VerdictCode::valve_saturation:
      return priors.valve_saturation;
    case VerdictCode::valve_characteristic:
      return priors.valve_characteristic;
    case VerdictCode::valve_oversized:
      return priors.valve_oversized;
    case VerdictCode::process_nonlinearity:
      return priors.process_nonlinearity;
    case VerdictCode::external_disturbance:
      return priors.external_disturbance;
    case VerdictCode::process_change:
      return priors.process_change;
    case VerdictCode::sensor_fault:
      return priors.sensor_fault;
    case VerdictCode::tight_tuning:
      return priors.tight_tuning;
    case VerdictCode::sluggish_tuning:
      return priors.sluggish_tuning;
    default:
      return 0.0;
  }
}

/// What its own figures say.
WeighedCause weigh(const PlacedCause& cause, const std::vector<std::optional<double>>& values) {
  const CauseCurves& curves = *cause.curves;
  WeighedCause weighed{cause.code, curves.log_odds, curves.share, {}};
  for (std::size_t k = 0; k < curves.curves.size(); ++k) {
    const std::optional<double> value = values[cause.figures[k]];
    const double weight =
        weight_at(curves.curves[k], value.value_or(std::numeric_limits<double>::quiet_NaN()));
    weighed.log_odds += weight;
    weighed.parts.push_back({cause.figures[k], value, weight});
  }
  weighed.evidence = weighed.log_odds - log_odds_of(curves.share);
  return weighed;
}

void shift(WeighedCause& cause, const Priors& priors) {
  const double prior = prior_of(cause.code, priors);
  if (!(prior > 0.0)) return;
  cause.log_odds += log_odds_of(prior) - log_odds_of(cause.prior);
  cause.prior = prior;
}

/// `result`, by its own figures, beside the others, as probable as they are in this plant.
WeighedCause beside_all(WeighedCause result, std::size_t place, std::span<const OwnOdds> all) {
  const ExplainingAway& beside = *all[place].beside;
  for (Part& part : result.parts) part.weight *= beside.scale;
  for (const OthersPart& part : parts_of_others(place, all))
    result.parts.push_back({std::nullopt, part.probability, part.weight, part.first});
  result.log_odds = explaining_away(result.log_odds, place, all);
  return result;
}

/// Of valve and controller nothing is said where op says nothing.
bool needs_op(VerdictCode code) {
  const plant::Fault blames = catalogue_entry(code).blames;
  return blames == plant::Fault::friction || blames == plant::Fault::valve ||
         blames == plant::Fault::tuning;
}

}  // namespace

double WeighedCause::probability() const {
  return probability_of(log_odds);
}

double probability_in(const Causes& causes, VerdictCode code) {
  const auto found = std::ranges::find(causes, code, &WeighedCause::code);
  return found == causes.end() ? 0.0 : found->probability();
}

PerCause priors_of(const DecisionSettings& settings) {
  PerCause priors;
  for (const PlacedCause& cause : placed_table(true)) {
    const double set = prior_of(cause.code, settings.priors);
    set_cause(priors, cause.code, set > 0.0 ? set : cause.curves->share);
  }
  return priors;
}

Causes weigh_causes(const Evidence& evidence, const DecisionSettings& settings) {
  const std::vector<std::optional<double>> values = measure_figures(evidence);
  const std::vector<PlacedCause>& table = placed_table(evidence.model.has_value());
  std::vector<WeighedCause> alone;
  std::vector<OwnOdds> all;
  for (const PlacedCause& cause : table) {
    alone.push_back(weigh(cause, values));
    WeighedCause here = alone.back();
    shift(here, settings.priors);
    all.push_back({cause.code, here.log_odds, &cause.curves->beside});
  }
  Causes causes;
  for (std::size_t k = 0; k < table.size(); ++k) {
    WeighedCause cause = beside_all(std::move(alone[k]), k, all);
    shift(cause, settings.priors);
    std::ranges::stable_sort(cause.parts, std::greater{},
                             [](const Part& part) { return std::abs(part.weight); });
    causes.push_back(std::move(cause));
  }
  std::ranges::stable_sort(causes, std::greater{}, &WeighedCause::log_odds);
  return causes;
}

Causes known_causes(const Evidence& evidence, const DecisionSettings& decision) {
  Causes causes = weigh_causes(evidence, decision);
  if (!op_speaks(evidence))
    std::erase_if(causes, [](const WeighedCause& cause) { return needs_op(cause.code); });
  return causes;
}

void check(const DecisionSettings& settings) {
  const auto refuse = [](const char* what) {
    throw std::invalid_argument(std::string("decision: ") + what);
  };
  if (!(settings.line >= 0.0) || settings.line > 1.0) refuse("line has to be from 0 to 1");
  for (const VerdictCode code : all_verdict_codes()) {
    const double prior = prior_of(code, settings.priors);
    if (!(prior >= 0.0) || prior >= 1.0) refuse("a prior has to be 0, or more and below 1");
  }
}

}  // namespace loopscope::core::diagnosis
