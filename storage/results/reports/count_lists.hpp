#pragma once

#include <cstdint>
#include <span>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::storage {

/// What the first screen counts of the work list and of what is kept off it: flagged, new_flags
/// (known to have begun after `since_us`), victims, annotated, unlisted, annotations, and the
/// newest thirty of these. The other fields of `counts` stay.
void count_lists(std::span<const FlaggedRow> flagged, std::span<const HiddenLoopRow> hidden,
                 std::int64_t since_us, PlantCounts& counts);

}  // namespace loopscope::storage
