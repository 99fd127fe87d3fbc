#pragma once

#include "core/diagnosis/case.hpp"
#include "core/diagnosis/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The branch of the flow for records without quadratic coupling: an oscillation is a symmetric
/// limit cycle, comes from outside or from tight tuning; a quiet loop is coarse, slow or healthy.
[[nodiscard]] Verdict uncoupled_verdict(const Case& loop);

}  // namespace loopscope::core::diagnosis
