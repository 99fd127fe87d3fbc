#pragma once

#include <string_view>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// p of "nothing is left in the residual": the smallest of whiteness and the residual tests that no
/// step answers, times the number of all (Bonferroni: which are answered is known afterwards), 0
/// to 1.
[[nodiscard]] double structure_p(const model::Explanation& explanation);

/// Something is in the loop that is clearly not noise: one healthy loop in a thousand leaves as
/// much behind, couples as much or oscillates as clearly.
[[nodiscard]] bool is_structured(const Evidence& evidence);

/// A nonlinearity of valve or process shows: coupling with p <= alpha, a step of the model, or a
/// residual test that asks for one.
[[nodiscard]] bool shows_nonlinearity(const Evidence& evidence, double alpha);

/// An oscillation is present and carries at least a fifth of the error's variance.
[[nodiscard]] bool oscillates(const Evidence& evidence);

/// One of DataQuality::flags.
[[nodiscard]] bool has_flag(const Evidence& evidence, std::string_view flag);

/// op was recorded and moves: without that nothing is claimed of controller and valve.
[[nodiscard]] bool op_speaks(const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
