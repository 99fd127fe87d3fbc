#pragma once

#include "core/model/effect_traits.hpp"

namespace loopscope::core::model {

[[nodiscard]] const EffectTraits& traits_of(EffectKind kind);

}  // namespace loopscope::core::model
