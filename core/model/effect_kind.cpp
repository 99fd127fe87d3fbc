#include "core/model/effect_kind.hpp"

#include <array>

namespace loopscope::core::model {
namespace {

using enum EffectKind;

constexpr std::array kAll = {
    valve_stiction,       valve_deadband,       valve_saturation, valve_characteristic,
    process_nonlinearity, external_oscillation, load_step,        gain_change,
    sensor_quantisation,  sensor_hold};

}  // namespace

std::string_view name(EffectKind kind) {
  switch (kind) {
    case valve_stiction:
      return "valve_stiction";
    case valve_deadband:
      return "valve_deadband";
    case valve_saturation:
      return "valve_saturation";
    case valve_characteristic:
      return "valve_characteristic";
    case process_nonlinearity:
      return "process_nonlinearity";
    case external_oscillation:
      return "external_oscillation";
    case load_step:
      return "load_step";
    case gain_change:
      return "gain_change";
    case sensor_quantisation:
      return "sensor_quantisation";
    case sensor_hold:
      return "sensor_hold";
  }
  return "";
}

bool is_valve_hysteresis(EffectKind kind) {
  return kind == valve_stiction || kind == valve_deadband;
}

bool bends_flow(EffectKind kind) {
  return is_valve_hysteresis(kind) || kind == valve_saturation;
}

bool moves_on_half(EffectKind kind) {
  return kind != gain_change;
}

bool same_cause(EffectKind a, EffectKind b) {
  const auto outside = [](EffectKind kind) {
    return kind == external_oscillation || kind == load_step;
  };
  const auto sensor = [](EffectKind kind) {
    return kind == sensor_quantisation || kind == sensor_hold;
  };
  return a == b || (outside(a) && outside(b)) || (sensor(a) && sensor(b));
}

std::span<const EffectKind> all_effect_kinds() {
  return kAll;
}

}  // namespace loopscope::core::model
