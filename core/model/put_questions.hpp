#pragma once

#include <vector>

#include "core/model/fit.hpp"
#include "core/model/model_input.hpp"
#include "core/model/question_residual.hpp"

namespace loopscope::core::model {

/// The model run on op alone, pv units.
[[nodiscard]] std::vector<double> response_of(const LoopData& data, const Fit& fit);

/// What the one-step errors of a fit still hold, by the residual tests and by those of core/hos.
/// `data` and `fit` are of the record in `input`.
[[nodiscard]] std::vector<Answer> question(const ModelInput& input, const LoopData& data,
                                           const Fit& fit);
[[nodiscard]] std::vector<Answer> question_coupling(const ModelInput& input, const LoopData& data,
                                                    const Fit& fit);

}  // namespace loopscope::core::model
