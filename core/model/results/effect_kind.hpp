#pragma once

namespace loopscope::core::model {

/// The closed list of effects that a loop model can take in; name() of effects/effect_catalogue.hpp
/// gives the word that users, scripts and the results schema see.
enum class EffectKind {
  valve_stiction,
  valve_deadband,
  valve_saturation,
  valve_characteristic,
  process_nonlinearity,
  external_oscillation,
  load_step,
  gain_change,
  sensor_quantisation,
  sensor_hold,
};

}  // namespace loopscope::core::model
