#pragma once

#include <string>

#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// A model that leaves less than this of what could be explained is enough.
inline constexpr double kNearlyAll = 0.1;

/// What the model leaves of what could be explained, in agreement with the test of whiteness; that
/// its figures are rough where it is not enough.
[[nodiscard]] std::string left_text(const model::Explanation& explanation);

/// Why the noise floor stands above the last error, and what follows; empty where it does not.
[[nodiscard]] std::string floor_text(const model::Explanation& explanation);

/// How much of the linear model's error the effects take off together; empty without an effect that
/// lowers it.
[[nodiscard]] std::string effects_text(const model::Explanation& explanation);

}  // namespace loopscope::core::diagnosis
