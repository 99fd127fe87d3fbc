#pragma once

#include "core/diagnosis/verdict.hpp"
#include "core/model/explanation.hpp"

namespace loopscope::core::diagnosis {

/// The verdict whose steps together explain most of the error.
struct LeadingEffect {
  VerdictCode code = VerdictCode::unexplained;
  const model::Step* strongest = nullptr;  ///< of its steps; points into the explanation
  double share =
      1.0;  ///< of what the steps of all verdicts explain, 0 to 1; 1 = no step explains anything
};

/// `explanation.steps` is not empty. Of equals the verdict that was taken in first leads.
[[nodiscard]] LeadingEffect leading_effect(const model::Explanation& explanation);

}  // namespace loopscope::core::diagnosis
