#pragma once

#include "core/model/effects/effect_traits.hpp"

namespace loopscope::core::model {

/// What the sensor does is found by its residual tests alone (sensor_steps.hpp).
inline constexpr EffectTraits kCoarseGrid{.kind = EffectKind::sensor_quantisation,
                                          .word = "sensor_quantisation",
                                          .cause = EffectKind::sensor_hold,
                                          .place = Place::sensor};
inline constexpr EffectTraits kHeldValue{.kind = EffectKind::sensor_hold,
                                         .word = "sensor_hold",
                                         .cause = EffectKind::sensor_hold,
                                         .place = Place::sensor};

}  // namespace loopscope::core::model
