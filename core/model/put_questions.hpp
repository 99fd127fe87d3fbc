#pragma once

#include <vector>

#include "core/model/fit.hpp"
#include "core/model/model_input.hpp"
#include "core/model/question_residual.hpp"

namespace loopscope::core::model {

/// What a story starts from is asked of the linear loop; all questions but those of core/hos, which
/// cost more than the others together, where there is no story; all of them at its end.
enum class Depth { first, quick, full };

/// The model run on op alone, pv units.
[[nodiscard]] std::vector<double> response_of(const LoopData& data, const Fit& fit);

/// What the one-step errors of a fit still hold. `data` and `fit` are of the record in `input`.
/// `known`: of Depth::first about the same fit, not asked again at full depth.
[[nodiscard]] std::vector<Answer> question(const ModelInput& input, const LoopData& data,
                                           const Fit& fit, Depth depth,
                                           const std::vector<Answer>& known = {});

/// p of the question op_direction alone, put to the one-step errors of a fit; 1 where it cannot be
/// asked.
[[nodiscard]] double p_of_op_direction(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
