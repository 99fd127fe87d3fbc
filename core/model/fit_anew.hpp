#pragma once

#include <limits>
#include <optional>

#include "core/model/fit.hpp"

namespace loopscope::core::model {

/// A valve by each of the other laws, left to itself, from the process that its own has found: the
/// wrong law at the right band shows the process well enough for the right law to show. nullopt
/// where none is better, on the fit rows, than a valve that follows its own law alone.
[[nodiscard]] std::optional<Fit> cross_laws(const LoopData& data, const Fit& fit);

/// The structure with its effects, everything fitted anew: effect, delay, poles, noise. A valve
/// that leaves more than `hopeless` (a fit_error) once the process has been searched behind it is
/// returned as it is then: the search for its band and jump is the costly part.
[[nodiscard]] Fit fit_anew(const LoopData& data, Fit fit,
                           double hopeless = std::numeric_limits<double>::infinity());

}  // namespace loopscope::core::model
