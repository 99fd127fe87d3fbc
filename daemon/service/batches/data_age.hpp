#pragma once

#include <span>
#include <string>

#include "daemon/monitor/metrics.hpp"
#include "daemon/service/batches/loop_task.hpp"

namespace loopscope::daemon {

/// Notes for the metrics how old the newest row of these loops' tags is, and how many values had a
/// quality that no rule explains. All visits are of one source.
void note_data(const std::string& source, std::span<const LoopTask> visits, Metrics& metrics);

}  // namespace loopscope::daemon
