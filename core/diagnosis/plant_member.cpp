#include "core/diagnosis/plant_member.hpp"

#include "core/diagnosis/catalogue.hpp"
#include "core/diagnosis/nonlinearity.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// That one of the causes is there which tell neighbours so.
double probability_of(plant::Fault blamed, const Verdict& verdict) {
  double none = 1.0;
  for (const CauseReport& cause : verdict.causes)
    if (catalogue_entry(cause.code).blames == blamed) none *= 1.0 - cause.probability;
  return 1.0 - none;
}

}  // namespace

plant::OwnFindings own_findings(const Evidence& evidence, const Verdict& verdict) {
  plant::OwnFindings own;
  own.fault = catalogue_entry(verdict.code).blames;
  own.confidence = verdict.confidence;
  own.friction_p = probability_of(plant::Fault::friction, verdict);
  own.outside_p = probability_of(plant::Fault::disturbance, verdict);
  if (evidence.hos) {
    if (evidence.hos->nonlinear_p) own.nonlinear_p = nonlinear_p(evidence);
    own.cubic_p = evidence.hos_slow ? evidence.hos_slow->result.cubic_p : evidence.hos->cubic_p;
  }
  if (!evidence.model) return own;
  for (const model::Step& step : evidence.model->steps) {
    double& explained = model::is_valve_hysteresis(step.effect) ? own.valve_explained
                        : step.effect == model::EffectKind::external_oscillation
                            ? own.outside_explained
                            : own.other_explained;
    explained += model::explained_by(step);
  }
  return own;
}

}  // namespace loopscope::core::diagnosis
