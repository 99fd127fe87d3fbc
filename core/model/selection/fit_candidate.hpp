#pragma once

#include <limits>
#include <optional>

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// The structure with its effects, everything fitted anew: effect, delay, poles, noise. A valve
/// that leaves more than `hopeless` (a fit_error) once the process has been searched behind it is
/// returned as it is then: the search for its band and jump is the costly part.
[[nodiscard]] Fit fit_candidate(const LoopData& data, Fit fit,
                                double hopeless = std::numeric_limits<double>::infinity());

}  // namespace loopscope::core::model
