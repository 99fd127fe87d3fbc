#pragma once

#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// Writes the records of loops whose lease was confirmed in the same transaction: analysis rows,
/// and peaks, steps of the loop model and verdict of each that is new or whose input has changed.
/// Every loop has a record. Counts inserted, revised and unchanged.
WriteCount write_records(Transaction& transaction, const std::vector<const CompletedLoop*>& loops);

}  // namespace loopscope::storage
