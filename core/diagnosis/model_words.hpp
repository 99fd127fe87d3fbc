#pragma once

#include <string>

#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// One step in a sentence: what it is, its figures, the held-out error before and after, p.
[[nodiscard]] std::string step_text(const model::Step& step);

/// What the model leaves, in a sentence.
[[nodiscard]] std::string unexplained_text(const model::Explanation& explanation);

/// The implied closed loop in a sentence: sensitivity, damping, period, settling time.
[[nodiscard]] std::string closed_loop_text(const model::ClosedLoop& loop);

}  // namespace loopscope::core::diagnosis
