#pragma once

#include <vector>

#include "tests/effects/kinds.hpp"

namespace loopscope::tests::effects {

/// Share of the floor that an effect has to add to the one-step error. A model of ten parameters
/// costs 1 to 2 % of it to fit, and of what is explainable 85 % is to be explained with an error of
/// at most 1.1 floors left: less than a tenth would put both into the doubt of the fit.
inline constexpr double kLeastExplainable = 0.10;

/// The recipes with the excitation and the quiet transmitters that let effects which are spread
/// over the record be seen; load steps, which live in a few samples, and sensors stay.
[[nodiscard]] std::vector<Recipe> realistic(std::vector<Recipe> recipes);

}  // namespace loopscope::tests::effects
