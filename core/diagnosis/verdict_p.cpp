#include "core/diagnosis/verdict_p.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effect_verdict.hpp"
#include "core/diagnosis/evidence/loop_figures.hpp"
#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Of 5700 healthy loops 0.012 lead with an effect of evidence 30 and more, 0.0044 of 40, 0.0016 of
/// 53, 0.0007 of 72, 0.0004 of 104.
constexpr double kHealthyShare = 0.02;
constexpr double kHealthyScale = 25.0;

double oscillation_p(const Evidence& evidence) {
  return oscillates(evidence) ? evidence.oscillation.p.value_or(1.0) : 1.0;
}

/// Of the clearest step that ends in this verdict, or in its sister: friction and play are one fit.
std::optional<double> step_p(VerdictCode code, const Evidence& evidence) {
  if (!evidence.model) return std::nullopt;
  const auto friction = [](VerdictCode verdict) {
    return verdict == VerdictCode::valve_stiction || verdict == VerdictCode::valve_deadband ||
           verdict == VerdictCode::valve_oversized;
  };
  std::optional<double> smallest;
  for (const model::Step& step : evidence.model->steps) {
    const VerdictCode verdict = verdict_of(step);
    if (verdict != code && !(friction(verdict) && friction(code))) continue;
    if (!evidence.model->excited && !model::is_seen_without_op(step.effect)) continue;
    smallest = std::min(smallest.value_or(1.0), measured_p(step));
  }
  return smallest;
}

/// How often healthy loops remember as long: of 4853 simulated ones (tests/verdict, seeds 1 to 50
/// 000) 0.28 above 1, 0.027 above 2, 0.0076 above 3, 0.0025 above 4, 0.0008 above 6.
constexpr double kMemoryShare = 0.27;
constexpr double kMemoryPower = 3.3;

/// Far from the best controller, and by the controller's own measure as well, where that is known.
double slow_p(const Evidence& evidence) {
  const double harris_p = evidence.performance.harris_p.value_or(1.0);
  const std::optional<double> memory = memory_by_controller(evidence);
  if (!memory || !(*memory > 0.0)) return harris_p;
  return std::max(harris_p, std::min(1.0, kMemoryShare * std::pow(*memory, -kMemoryPower)));
}

double left_p(const Evidence& evidence) {
  const bool known = evidence.model && evidence.model->excited;
  return known ? structure_p(*evidence.model) : 1.0;
}

/// Positioners hold half a percent; twice that is more than their tolerance.
constexpr double kFaultyWidthPercent = 1.0;
/// Disturbances push op to its limit for a moment.
constexpr double kAtLimit = 0.05;

/// Seen and not inferred: a recorded position that does not follow, op at a limit of its range; the
/// grid, the age and the rests of pv are the data themselves.
bool is_fact(VerdictCode code, const Evidence& evidence) {
  switch (code) {
    case VerdictCode::valve_stiction:
    case VerdictCode::valve_deadband:
      return evidence.op_range_set &&
             evidence.shape.mv_op_width.value_or(0.0) + evidence.shape.mv_slip_jump.value_or(0.0) >=
                 kFaultyWidthPercent;
    case VerdictCode::valve_saturation:
      return evidence.data_quality.saturated_fraction.value_or(0.0) > kAtLimit;
    case VerdictCode::sensor_fault:
      return has_flag(evidence, "pv_quantised") || has_flag(evidence, "pv_held") ||
             has_flag(evidence, "pv_frozen");
    default:
      return false;
  }
}

/// Where no step of a model shows the cause.
double statistics_p(VerdictCode code, const Evidence& evidence) {
  switch (code) {
    case VerdictCode::external_disturbance:
    case VerdictCode::tight_tuning:
      return oscillation_p(evidence);
    case VerdictCode::valve_stiction:
    case VerdictCode::valve_deadband:
    case VerdictCode::valve_oversized:
      return std::min(nonlinear_p(evidence), oscillation_p(evidence));
    case VerdictCode::sluggish_tuning:
      return slow_p(evidence);
    case VerdictCode::unexplained:
      return std::min({nonlinear_p(evidence), oscillation_p(evidence), left_p(evidence)});
    default:
      return nonlinear_p(evidence);
  }
}

}  // namespace

double measured_p(const model::Step& step) {
  if (!(step.evidence >= 0.0)) return 1.0;
  const double own = step.p >= 0.0 ? std::min(step.p, 1.0) : 1.0;
  const double among_healthy = kHealthyShare * std::exp(-step.evidence / kHealthyScale);
  return std::clamp(among_healthy, own, 1.0);
}

std::optional<double> p_of_verdict(VerdictCode code, const Evidence& evidence) {
  if (catalogue_entry(code).weight == 0.0) return std::nullopt;
  if (is_fact(code, evidence)) return std::nullopt;
  const double by_statistics = statistics_p(code, evidence);
  return std::min(step_p(code, evidence).value_or(1.0), by_statistics);
}

}  // namespace loopscope::core::diagnosis
