#pragma once

#include <string>

#include "core/model/results/explanation.hpp"

namespace loopscope::daemon {

/// The report of the loop model for a terminal: baseline, each step with the error before and after
/// and the residual tests that asked for it, what is left, and the closed loop that the records
/// imply.
[[nodiscard]] std::string model_text(const core::model::Explanation& explanation);

}  // namespace loopscope::daemon
