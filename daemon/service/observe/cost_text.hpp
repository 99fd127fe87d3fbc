#pragma once

#include <string>

#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// "ms a loop: claim 0.1, fetch 2.3, prepare 0.2, statistics 0.5, model 3.1 (17.4 each of 356),
/// decide 0.2, write 0.9, waiting 1.2"; empty when no loop was done.
[[nodiscard]] std::string cost_text(const storage::StageCost& cost);

}  // namespace loopscope::daemon
