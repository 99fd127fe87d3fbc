#pragma once

#include <span>

#include "storage/results/reports/listed_loops.hpp"
#include "storage/results/reports/report_rows.hpp"
#include "storage/results/session/snapshot.hpp"

namespace loopscope::storage {

/// The catalogue's loops as they stand in the snapshot, flagged ones first by rank, then by name.
/// `flagged` and `hidden`: the work list and what is kept off it, of the same snapshot. Throws
/// DatabaseError.
[[nodiscard]] ListedLoops list_loops(Snapshot& snapshot, std::span<const FlaggedRow> flagged,
                                     std::span<const HiddenLoopRow> hidden);

}  // namespace loopscope::storage
