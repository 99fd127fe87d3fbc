#pragma once

#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/plant/member_loop.hpp"

namespace loopscope::core::diagnosis {

/// What the loop's own diagnosis tells the plant.
[[nodiscard]] plant::OwnFindings own_findings(const Verdict& verdict);

}  // namespace loopscope::core::diagnosis
