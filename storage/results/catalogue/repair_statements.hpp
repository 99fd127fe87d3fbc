#pragma once

#include "storage/statement.hpp"

namespace loopscope::storage::statements {

/// $1 = algorithm revision, $2 = how many. A row per piece of work.
extern const Statement kDueRepairs;
/// $1 = bigint[] of maintenance_event_id. A row per window, nearest to the work first.
extern const Statement kRepairWindows;
extern const Statement kStoreRepairJudgement;

}  // namespace loopscope::storage::statements
