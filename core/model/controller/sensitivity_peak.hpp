#pragma once

#include "core/model/controller/controller_law.hpp"
#include "core/model/controller/sampled_process.hpp"

namespace loopscope::core::model {

/// Ms and where it is.
struct SensitivityPeak {
  double value = 1.0;      ///< >= 1
  double frequency = 0.0;  ///< radians per sample, 0 to pi
};

/// Greatest |1 / (1 + G C)| over pi / 1000 <= w <= pi, the loop being stable.
[[nodiscard]] SensitivityPeak find_sensitivity_peak(const SampledProcess& process,
                                                    const ControllerLaw& law);

}  // namespace loopscope::core::model
