#pragma once

#include <vector>

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// By row, what is left of pv when the model runs on op alone, less an offset and a slow (cubic)
/// drift fitted to the fit rows; scaled pv units.
[[nodiscard]] std::vector<double> simulation_residual(const LoopData& data, const Fit& fit);

/// Its mean square on the held-out rows, scaled pv units squared.
[[nodiscard]] double simulation_error(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
