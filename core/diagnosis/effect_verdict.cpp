#include "core/diagnosis/effect_verdict.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Of loads that come at any time so many are blamed on the answer to the setpoint.
constexpr double kHardlyByChance = 0.05;

}  // namespace

VerdictCode verdict_of(model::EffectKind effect) {
  using enum model::EffectKind;
  switch (effect) {
    case valve_stiction:
      return VerdictCode::valve_stiction;
    case valve_deadband:
      return VerdictCode::valve_deadband;
    case valve_saturation:
      return VerdictCode::valve_saturation;
    case valve_characteristic:
      return VerdictCode::valve_characteristic;
    case process_nonlinearity:
      return VerdictCode::process_nonlinearity;
    case external_oscillation:
    case load_step:
      return VerdictCode::external_disturbance;
    case gain_change:
      return VerdictCode::process_change;
    case sensor_quantisation:
    case sensor_hold:
      return VerdictCode::sensor_fault;
  }
  return VerdictCode::unexplained;
}

VerdictCode verdict_of(const model::Step& step) {
  if (step.setpoint_chance <= kHardlyByChance) return VerdictCode::unexplained;
  return step.cycle_indicates_stiction ? VerdictCode::valve_stiction : verdict_of(step.effect);
}

}  // namespace loopscope::core::diagnosis
