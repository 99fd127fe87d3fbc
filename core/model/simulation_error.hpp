#pragma once

#include "core/model/fit.hpp"

namespace loopscope::core::model {

/// Mean square, on the held-out rows, of what is left of pv when the model runs on op alone, less
/// an offset and a slow (cubic) drift fitted to the fit rows; scaled pv units squared.
[[nodiscard]] double simulation_error(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
