#pragma once

#include <optional>

#include "core/model/record/model_input.hpp"
#include "core/model/results/explanation.hpp"
#include "core/model/selection/stepwise_model.hpp"

namespace loopscope::core::model {

/// An explanation with the fits that it was read off.
struct FittedLoop {
  Explanation explanation;
  /// Every sample a row. Without chapters where `renewals` has them.
  StepwiseModel samples;
  /// Of a held sensor that is renewed often enough: the same on the rows of its renewals.
  std::optional<StepwiseModel> renewals;
};

/// explain(), and what it keeps to itself.
[[nodiscard]] std::optional<FittedLoop> fit_loop_model(const ModelInput& input);

}  // namespace loopscope::core::model
