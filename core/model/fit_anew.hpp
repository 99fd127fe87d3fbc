#pragma once

#include <limits>
#include <optional>

#include "core/model/fit.hpp"

namespace loopscope::core::model {

/// The structure with its effects, everything fitted anew: effect, delay, poles, noise. A valve
/// that leaves more than `hopeless` (a fit_error) once the process has been searched behind it is
/// returned as it is then: the search for its band and jump is the costly part.
[[nodiscard]] Fit fit_anew(const LoopData& data, Fit fit,
                           double hopeless = std::numeric_limits<double>::infinity());

/// A valve that has been fitted, looked at between the samples (stem_search.hpp) from the process
/// that was found behind it: one that is only about right shows the process well enough for the
/// right one to show. nullopt where none is better, on the fit rows, than a valve that follows its
/// law alone.
[[nodiscard]] std::optional<Fit> sought_between_samples(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
