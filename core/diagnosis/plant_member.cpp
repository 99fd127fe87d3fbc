#include "core/diagnosis/plant_member.hpp"

#include "core/diagnosis/nonlinearity.hpp"

namespace loopscope::core::diagnosis {

plant::Fault fault_of(VerdictCode code) {
  switch (code) {
    case VerdictCode::valve_stiction:
    case VerdictCode::valve_deadband:
    case VerdictCode::valve_oversized:
      return plant::Fault::friction;
    case VerdictCode::valve_saturation:
    case VerdictCode::valve_characteristic:
      return plant::Fault::valve;
    case VerdictCode::process_nonlinearity:
    case VerdictCode::process_change:
      return plant::Fault::process;
    case VerdictCode::sensor_fault:
      return plant::Fault::sensor;
    case VerdictCode::tight_tuning:
    case VerdictCode::sluggish_tuning:
      return plant::Fault::tuning;
    case VerdictCode::external_disturbance:
      return plant::Fault::disturbance;
    case VerdictCode::nonlinear_unexplained:
    case VerdictCode::unexplained:
      return plant::Fault::unexplained;
    case VerdictCode::healthy:
    case VerdictCode::insufficient_data:
      break;
  }
  return plant::Fault::none;
}

plant::OwnFindings own_findings(const Evidence& evidence, const Verdict& verdict) {
  plant::OwnFindings own;
  own.fault = fault_of(verdict.code);
  own.confidence = verdict.confidence;
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
