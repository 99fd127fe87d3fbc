#pragma once

#include <vector>

#include "core/model/effects/effect.hpp"
#include "core/model/response/noise_model.hpp"
#include "core/model/response/process_shape.hpp"

namespace loopscope::core::model {

/// A loop model but for the coefficients that least squares gives.
struct Structure {
  ProcessShape process;
  NoiseModel noise;
  bool second_order = false;  ///< the second lag is fitted too
  bool two_taps = false;      ///< the numerator has its second coefficient; every sample is a row
  std::vector<EffectPtr> effects;
};

/// With one effect more, with another last one, without the last one.
[[nodiscard]] Structure with(Structure structure, EffectPtr effect);
[[nodiscard]] Structure with_last(Structure structure, EffectPtr effect);
[[nodiscard]] Structure without_last(Structure structure);

}  // namespace loopscope::core::model
