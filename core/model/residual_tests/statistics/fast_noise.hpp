#pragma once

#include "core/model/residual_tests/statistics/residual_view.hpp"

namespace loopscope::core::model {

/// How much pv varies from one sample to the next, pv units: the larger of the standard deviations
/// of its increments over sqrt(2) and of the innovations, each without its largest fiftieth
/// (setpoint and load steps). 0 when nothing varies.
[[nodiscard]] double fast_noise_std(const ResidualView& view);

}  // namespace loopscope::core::model
