#include "core/model/effect_kind.hpp"

#include "core/model/effects/catalogue.hpp"

namespace loopscope::core::model {

std::string_view name(EffectKind kind) {
  return traits_of(kind).word;
}

bool is_valve_hysteresis(EffectKind kind) {
  return kind == EffectKind::valve_stiction || kind == EffectKind::valve_deadband;
}

bool bends_flow(EffectKind kind) {
  return traits_of(kind).place == Place::valve;
}

bool is_from_outside(EffectKind kind) {
  return traits_of(kind).place == Place::outside;
}

bool is_seen_without_op(EffectKind kind) {
  return is_from_outside(kind) || traits_of(kind).place == Place::sensor;
}

bool same_cause(EffectKind a, EffectKind b) {
  return traits_of(a).cause == traits_of(b).cause;
}

}  // namespace loopscope::core::model
