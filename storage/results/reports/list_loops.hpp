#pragma once

#include <pqxx/pqxx>

#include "storage/results/reports/loop_query.hpp"
#include "storage/results/session/snapshot.hpp"

namespace loopscope::storage {

/// One page of the catalogue's loops as they stand in the snapshot. A text of `query` that no loop
/// can have, because PostgreSQL refuses it, fits none. Throws DatabaseError.
[[nodiscard]] LoopListing list_loops(Snapshot& snapshot, const LoopQuery& query);

}  // namespace loopscope::storage
