#pragma once

#include <span>
#include <string_view>

#include "core/model/effects/effect_traits.hpp"

namespace loopscope::core::model {

[[nodiscard]] const EffectTraits& traits_of(EffectKind kind);

[[nodiscard]] std::string_view name(EffectKind kind);

/// Sticks or has play: the two are one fit, told apart by the jump that it ends with.
[[nodiscard]] bool is_valve_hysteresis(EffectKind kind);

/// Acts between op and flow, so that the process has to be searched again behind it.
[[nodiscard]] bool bends_flow(EffectKind kind);

/// A wave or a load: by time alone, whatever op does.
[[nodiscard]] bool is_from_outside(EffectKind kind);
/// A wave, a load, or what a sensor does: seen in pv, whether op moves or not.
[[nodiscard]] bool is_seen_without_op(EffectKind kind);

/// Both end in the same verdict.
[[nodiscard]] bool same_cause(EffectKind a, EffectKind b);

/// Every kind, in the order above.
[[nodiscard]] std::span<const EffectKind> all_effect_kinds();

}  // namespace loopscope::core::model
