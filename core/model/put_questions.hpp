#pragma once

#include <vector>

#include "core/model/fit.hpp"
#include "core/model/model_input.hpp"
#include "core/model/question_residual.hpp"

namespace loopscope::core::model {

/// The questions of core/hos cost more than all others: they are put to what is left at the end.
enum class Depth { quick, full };

/// The model run on op alone, pv units.
[[nodiscard]] std::vector<double> response_of(const LoopData& data, const Fit& fit);

/// What the one-step errors of a fit still hold. `data` and `fit` are of the record in `input`.
[[nodiscard]] std::vector<Answer> question(const ModelInput& input, const LoopData& data,
                                           const Fit& fit, Depth depth);

}  // namespace loopscope::core::model
