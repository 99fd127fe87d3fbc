#pragma once

#include <span>

#include "daemon/service/batches/loop_task.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// Adds what reading a batch took, first looks included: they are part of preparing.
void add_reading(double elapsed_s, std::span<const LoopTask> visits, storage::StageCost& cost);

/// Adds what analysing a batch took. What its records do not claim for statistics and model went
/// into digests, verdicts and their words.
void add_analyses(double elapsed_s, std::span<const storage::CompletedLoop> completed,
                  storage::StageCost& cost);

}  // namespace loopscope::daemon
