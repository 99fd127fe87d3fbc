#pragma once

#include "core/model/results/explanation.hpp"
#include "core/model/selection/stepwise_model.hpp"

namespace loopscope::core::model {

/// The steps of a model in the results' words: parameters with their spread, errors in pv units.
[[nodiscard]] std::vector<Step> report_steps(const StepwiseModel& stepwise);

}  // namespace loopscope::core::model
