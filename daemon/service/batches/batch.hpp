#pragma once

#include <optional>
#include <vector>

#include "daemon/service/batches/loop_task.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "daemon/text/failure.hpp"
#include "storage/results/results_database.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// Loops of one historian that a lane has claimed.
using Claims = std::vector<const storage::ClaimedLoop*>;

/// Claimed loops on their way through a lane: what was read, what has come of it, what it cost.
struct Batch {
  std::vector<LoopTask> visits;
  RowMemory rows;
  StoredAnalyses stored;
  std::vector<storage::CompletedLoop> completed;
  std::vector<storage::FailedLoop> failed;
  std::optional<Failure> first_failure;  ///< why loops stand in `failed`, the first of the reasons
  storage::StageCost cost = {};
};

/// The loop cannot be brought to its end: it waits, longer each time.
void set_aside(const storage::ClaimedLoop& claim, const Failure& failure, Batch& batch);

/// Their source is away: the loops wait, without blame.
void postpone(const Claims& claims, const Failure& failure, double pause_s, Batch& batch);

}  // namespace loopscope::daemon
