#include "core/diagnosis/cause_odds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/diagnosis/cause_curves.hpp"
#include "core/diagnosis/combined_odds.hpp"
#include "core/diagnosis/figure.hpp"

namespace loopscope::core::diagnosis {
namespace {

double probability_of(double log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds));
}

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
  return weighed;
}

void shift(WeighedCause& cause, const Priors& priors) {
  const double prior = prior_of(cause.code, priors);
  if (!(prior > 0.0)) return;
  cause.log_odds += log_odds_of(prior) - log_odds_of(cause.prior);
  cause.prior = prior;
}

/// The other causes of one, of those that have rivals themselves.
struct Rivals {
  double log_odds = 0.0;                ///< that any of them is there, were they independent
  const WeighedCause* first = nullptr;  ///< the most probable; nullptr = there is none
};

Rivals rivals_of(std::size_t place, const std::vector<WeighedCause>& causes,
                 const std::vector<PlacedCause>& table) {
  /// -ln of the probability that none is there; beyond it no double is below 1.
  constexpr double kSurest = 30.0;
  Rivals rivals;
  double none = 0.0;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    if (k == place || table[k].curves->rival.empty()) continue;
    const double odds = causes[k].log_odds;
    none += std::max(odds, 0.0) + std::log1p(std::exp(-std::abs(odds)));
    if (!rivals.first || odds > rivals.first->log_odds) rivals.first = &causes[k];
  }
  rivals.log_odds = std::log(std::expm1(std::min(none, kSurest)));
  return rivals;
}

/// `result`, by its own figures, beside the others, as probable as they are in this plant.
WeighedCause beside_rivals(WeighedCause result, std::size_t place,
                           const std::vector<WeighedCause>& others,
                           const std::vector<PlacedCause>& table) {
  const CauseCurves& curves = *table[place].curves;
  result.log_odds = curves.scale * result.log_odds + curves.offset;
  for (Part& part : result.parts) part.weight *= curves.scale;
  const Rivals rivals = rivals_of(place, others, table);
  if (rivals.first && !curves.rival.empty()) {
    const double weight = height_at(curves.rival, rivals.log_odds);
    result.log_odds += weight;
    result.parts.push_back(
        {std::nullopt, probability_of(rivals.log_odds), weight, rivals.first->code});
  }
  return result;
}

}  // namespace

double WeighedCause::probability() const {
  return probability_of(log_odds);
}

std::vector<WeighedCause> weigh_causes(const Evidence& evidence, const DecisionSettings& settings) {
  const std::vector<std::optional<double>> values = measure_figures(evidence);
  const std::vector<PlacedCause>& table = placed_table(evidence.model.has_value());
  std::vector<WeighedCause> alone, here;
  for (const PlacedCause& cause : table) {
    alone.push_back(weigh(cause, values));
    here.push_back(alone.back());
    shift(here.back(), settings.priors);
  }
  std::vector<WeighedCause> causes;
  for (std::size_t k = 0; k < table.size(); ++k) {
    WeighedCause cause = beside_rivals(std::move(alone[k]), k, here, table);
    shift(cause, settings.priors);
    std::ranges::stable_sort(cause.parts, std::greater{},
                             [](const Part& part) { return std::abs(part.weight); });
    causes.push_back(std::move(cause));
  }
  std::ranges::stable_sort(causes, std::greater{}, &WeighedCause::log_odds);
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
