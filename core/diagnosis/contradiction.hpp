#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/case.hpp"
#include "core/model/explanation.hpp"

namespace loopscope::core::diagnosis {

/// Why a fact refutes a step of the model: a valve position that follows its signal, a cycle that
/// is not about the valve's band, a pv that is renewed at every sample, or that lies on no grid.
/// Empty = nothing speaks against it.
[[nodiscard]] std::string contradiction_of(const model::Step& step, const Case& loop);

/// An explanation as the recorded facts leave it.
struct BelievedExplanation {
  model::Explanation explanation;   ///< without the refuted steps
  std::vector<std::string> doubts;  ///< one reason for each refuted step
};

/// `loop.evidence.model` is filled. In a level loop play whose cycle looks like that of a
/// valve that sticks stays play where it explains much and leaves nothing.
[[nodiscard]] BelievedExplanation believed(const Case& loop);

}  // namespace loopscope::core::diagnosis
